// neuralsvcd.c - the library compiled by itself, for those who link it: what make, CMake and Meson build.
#define NEURALSVCD_IMPLEMENTATION
#include "neuralsvcd.h"
