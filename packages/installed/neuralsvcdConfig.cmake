# For find_package(neuralsvcd), where `make install` put it: PREFIX/lib/cmake/neuralsvcd.
#   neuralsvcd::neuralsvcd  the header; one of your files defines NEURALSVCD_IMPLEMENTATION
#   neuralsvcd::library     compiled: the shared library if BUILD_SHARED_LIBS, else the static one
get_filename_component(neuralsvcd_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT TARGET neuralsvcd::neuralsvcd)
  add_library(neuralsvcd::neuralsvcd INTERFACE IMPORTED)
  set_target_properties(neuralsvcd::neuralsvcd PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${neuralsvcd_prefix}/include/neuralsvcd" INTERFACE_LINK_LIBRARIES m)
  add_library(neuralsvcd::library UNKNOWN IMPORTED)
  if(BUILD_SHARED_LIBS)
    file(GLOB neuralsvcd_file "${neuralsvcd_prefix}/lib/libneuralsvcd.so" "${neuralsvcd_prefix}/lib/libneuralsvcd.dylib")
  else()
    set(neuralsvcd_file "${neuralsvcd_prefix}/lib/libneuralsvcd.a")
  endif()
  set_target_properties(neuralsvcd::library PROPERTIES
    IMPORTED_LOCATION "${neuralsvcd_file}" INTERFACE_LINK_LIBRARIES neuralsvcd::neuralsvcd)
endif()
