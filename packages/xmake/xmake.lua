-- neuralsvcd.h for xmake, from the checkout that this file is in: includes("path/to/packages/xmake"), then
-- add_requires("neuralsvcd") and add_packages("neuralsvcd"). One of your files defines NEURALSVCD_IMPLEMENTATION.
package("neuralsvcd")
    set_kind("library", {headeronly = true})
    set_description("Does this body, moving along this trajectory, hit that body? A single header that answers with a proof")
    set_license("MIT")
    set_sourcedir(path.join(os.scriptdir(), "..", ".."))
    if not is_plat("windows") then
        add_syslinks("m")
    end
    on_install(function (package)
        os.cp("neuralsvcd.h", package:installdir("include"))
        os.cp("weights.h", package:installdir("include"))
        os.cp("extras/*.h", package:installdir("include/extras"))
    end)
    on_test(function (package)
        assert(package:check_csnippets({test = [[
            #define NEURALSVCD_IMPLEMENTATION
            #include <neuralsvcd.h>
            void test(void) { nsvcd_self_test(); }
        ]]}))
    end)
package_end()
