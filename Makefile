# neuralsvcd.h is one header: there is nothing to build in order to use it. This builds the examples and the tests. The
# header itself is made from the rooms of src/ by `make header`.
# `make help` lists the targets. A C compiler and make are enough; libccd is used by the tests where it is installed.
CC ?= cc
CXX ?= c++

# -O3 -march=native: the decoder and the broad phase are loops over floats, and wider vectors halve their time. Such a
# binary may not run on another machine: `make PORTABLE=1` leaves the instruction set at the compiler's default.
ifdef PORTABLE
CFLAGS ?= -O3
else
CFLAGS ?= -O3 -march=native
endif
WARNINGS = -Wall -Wextra
ALL_CFLAGS = $(CFLAGS) -std=c99 $(WARNINGS)
LIBRARY = neuralsvcd.h weights.h
ROOMS = $(wildcard src/*.h src/*/*.h)
# What the examples and the tests share.
SCENERY = $(wildcard examples/scenery/*.h examples/svcd/*.h)
# The checker of certificates, which knows nothing of the library.
VERIFIER = $(wildcard examples/verify/*.h)

# libccd checks the oracle on convex pairs. Found by pkg-config, or by its header where that is not installed.
HASH := \#
HAVE_CCD := $(shell (pkg-config --exists ccd || echo '$(HASH)include <ccd/ccd.h>' | $(CC) -E -x c - >/dev/null) \
  2>/dev/null && echo 1)
ifeq ($(HAVE_CCD),1)
CCD_CFLAGS := -DHAVE_LIBCCD $(shell pkg-config --cflags ccd 2>/dev/null)
CCD_LIBS := $(shell pkg-config --libs ccd 2>/dev/null || echo -lccd)
endif

ifeq ($(BENCH),quick)
COUNT ?= 200
endif

.PHONY: all demo preview assets header api help format clean firmware web weights problems accuracy
.PHONY: shared static release install uninstall check-packages
.PHONY: test check check-release
.PHONY: bench-one-path python mutants fuzz coverage mutate
.PHONY: bench bench-certificates bench-asks bench-casts bench-distance bench-flags bench-level bench-scale bench-plan race profile instructions sizes
.DELETE_ON_ERROR:

PLANNERS = build/dish_insertion build/bimanual_insertion build/mining_site
DEMOS = build/quickstart build/plan build/game build/fly_through $(PLANNERS)

all: build/svcd build/verify $(DEMOS)  ## the examples, in build/: svcd, verify, quickstart, plan, game, fly_through and three tasks for arms

help:  ## this list
	@sed -n 's/^\([a-z][a-z-]*\):.*##/\1:/p' $(MAKEFILE_LIST) | sort

build:
	mkdir -p build

header:  ## writes neuralsvcd.h from the rooms of src/
	python3 src/make_header.py
api: | build  ## build/api.html: what a program sees, as a page
	python3 src/make_api.py

# ---------------------------------------------------------------------------------------------------------- examples

EXAMPLES = $(patsubst examples/%.c,build/%,$(wildcard examples/*.c))
$(EXAMPLES): build/%: examples/%.c $(wildcard examples/*.h) $(SCENERY) $(LIBRARY) | build
	$(CC) $(ALL_CFLAGS) -o $@ $< -lm
build/game build/fly_through: WARNINGS += -Wno-unused-function  # of problem_file.h

build/verify: examples/verify/verify.c $(VERIFIER) | build
	$(CC) $(ALL_CFLAGS) -o $@ $< -lm

# What the modules of examples/python open.
build/_neuralsvcd.so: examples/python/_neuralsvcd.c $(LIBRARY) $(SCENERY) | build
	$(CC) $(ALL_CFLAGS) -I. -fPIC -shared -o $@ $< -lm
# What the module nsvcd_verify opens: the checker alone.
build/_nsvcd_verify.so: examples/python/_nsvcd_verify.c $(VERIFIER) | build
	$(CC) $(ALL_CFLAGS) -I. -fPIC -shared -o $@ $< -lm
python: build/_neuralsvcd.so build/_nsvcd_verify.so  ## the libraries for examples/python

demo: $(DEMOS)  ## the examples, seconds each: what they find, and a picture each in build/
	@for demo in $(DEMOS); do echo $$demo; $$demo || exit 1; done

preview: build/tasks_preview  ## the planning tasks as pictures: build/task_*.svg
	build/tasks_preview

assets: build/make_assets  ## writes examples/assets/*.obj, which are in the repository, anew
	build/make_assets examples/assets

# ---------------------------------------------------------------------------------------------------------- packages

PREFIX ?= /usr/local
VERSION := $(shell sed -n '1s/.* v\([0-9.]*\) .*/\1/p' neuralsvcd.h)
LIBRARY_CFLAGS ?= -O2
ifeq ($(shell uname -s),Darwin)
SHARED = build/libneuralsvcd.dylib
SONAME = -install_name $(PREFIX)/lib/libneuralsvcd.dylib
else
SHARED = build/libneuralsvcd.so
SONAME = -Wl,-soname,libneuralsvcd.so.$(VERSION)
endif

build/library.o: packages/neuralsvcd.c $(LIBRARY) | build
	$(CC) $(LIBRARY_CFLAGS) -std=c99 -fPIC -I. -c -o $@ $<
$(SHARED): build/library.o
	$(CC) -shared $(SONAME) -o $@ $< -lm
build/libneuralsvcd.a: build/library.o
	$(AR) rcs $@ $<
# For any machine, as the library is. A program called `verify` would be too much in a folder of all programs.
build/installed/svcd: examples/svcd.c $(SCENERY) $(LIBRARY)
build/installed/svcd-verify: examples/verify/verify.c $(VERIFIER)
PROGRAMS = build/installed/svcd build/installed/svcd-verify
$(PROGRAMS):
	@mkdir -p $(@D)
	$(CC) $(LIBRARY_CFLAGS) -std=c99 -o $@ $< -lm
shared: $(SHARED)  ## a shared library, build/libneuralsvcd.so
static: build/libneuralsvcd.a  ## a static one
# The name must stay: the header takes itself in.
release: build/release/neuralsvcd.h  ## one file that holds neuralsvcd.h and weights.h
build/release/neuralsvcd.h: $(LIBRARY)
	@mkdir -p $(@D)
	sed -e '/^#include "weights.h"$$/{r weights.h' -e 'd;}' neuralsvcd.h >$@

# DESTDIR=folder is put before PREFIX.
# The checker of certificates needs nothing of the library; what documents it all goes with it.
INSTALLED_HEADERS = $(LIBRARY) $(wildcard examples/verify/nsvcd_verify*.h)
DOCUMENTS = LICENSE examples/FORMATS.md
# What svcd says of itself, and where that is looked for.
MANUALS = man:man/man1/svcd.1 bash:bash-completion/completions/svcd zsh:zsh/site-functions/_svcd fish:fish/vendor_completions.d/svcd.fish
install: shared static $(PROGRAMS)  ## PREFIX=/usr/local: the headers, libraries, svcd, svcd-verify and their manual, pkg-config, a CMake package
	mkdir -p $(DESTDIR)$(PREFIX)/include/neuralsvcd $(DESTDIR)$(PREFIX)/lib/pkgconfig \
	  $(DESTDIR)$(PREFIX)/lib/cmake/neuralsvcd $(DESTDIR)$(PREFIX)/share/doc/neuralsvcd
	cp $(INSTALLED_HEADERS) $(DESTDIR)$(PREFIX)/include/neuralsvcd/
	cp $(DOCUMENTS) $(DESTDIR)$(PREFIX)/share/doc/neuralsvcd/
	cp build/libneuralsvcd.a $(DESTDIR)$(PREFIX)/lib/
	if test -f build/libneuralsvcd.dylib; then cp build/libneuralsvcd.dylib $(DESTDIR)$(PREFIX)/lib/; else \
	  cp $(SHARED) $(DESTDIR)$(PREFIX)/lib/libneuralsvcd.so.$(VERSION); \
	  ln -sf libneuralsvcd.so.$(VERSION) $(DESTDIR)$(PREFIX)/lib/libneuralsvcd.so; fi
	for name in neuralsvcd neuralsvcd-library; do \
	  sed 's|@PREFIX@|$(PREFIX)|; s|@LIBDIR@|lib|; s|@VERSION@|$(VERSION)|' packages/installed/$$name.pc.in \
	    >$(DESTDIR)$(PREFIX)/lib/pkgconfig/$$name.pc; done
	cp packages/installed/neuralsvcdConfig.cmake $(DESTDIR)$(PREFIX)/lib/cmake/neuralsvcd/
	sed 's|@VERSION@|$(VERSION)|' packages/installed/neuralsvcdConfigVersion.cmake.in \
	  >$(DESTDIR)$(PREFIX)/lib/cmake/neuralsvcd/neuralsvcdConfigVersion.cmake
	mkdir -p $(DESTDIR)$(PREFIX)/bin && cp $(PROGRAMS) $(DESTDIR)$(PREFIX)/bin/
	for manual in $(MANUALS); do file=$(DESTDIR)$(PREFIX)/share/$${manual#*:}; \
	  mkdir -p $$(dirname $$file) && build/installed/svcd --manual $${manual%%:*} >$$file || exit 1; done
	echo '.so man1/svcd.1' >$(DESTDIR)$(PREFIX)/share/man/man1/svcd-verify.1
uninstall:  ## takes it away again
	rm -rf $(DESTDIR)$(PREFIX)/include/neuralsvcd $(DESTDIR)$(PREFIX)/lib/cmake/neuralsvcd \
	  $(DESTDIR)$(PREFIX)/share/doc/neuralsvcd $(DESTDIR)$(PREFIX)/share/man/man1/svcd-verify.1 \
	  $(DESTDIR)$(PREFIX)/lib/libneuralsvcd.* $(DESTDIR)$(PREFIX)/lib/pkgconfig/neuralsvcd.pc \
	  $(DESTDIR)$(PREFIX)/lib/pkgconfig/neuralsvcd-library.pc $(PROGRAMS:build/installed/%=$(DESTDIR)$(PREFIX)/bin/%)
	for manual in $(MANUALS); do rm -f $(DESTDIR)$(PREFIX)/share/$${manual#*:}; done

# ------------------------------------------------------------------------------------------------------------- tests

HELPERS = $(wildcard tests/*.h tests/data/*.h) $(ROOMS) $(VERIFIER)
PEERS = $(wildcard tests/bench/*.h)
# Each test file holds the rooms of src/ that it is about, test_asks.c, test_round.c, test_exact.c, test_floor.c and test_processor.c the
# header as users have it, and uses only a part of their private functions. One instruction set is enough for most: test_processor.c has all that the processor knows,
# whatever the flags.
TEST_WARNINGS = -I. -Wall -Wextra -Werror -Wno-unused-function -DNSVCD_NO_DISPATCH
# Tests take less time to compile than -O3 costs: both together decide.
TEST_CFLAGS = $(CFLAGS:-O3=-O1)
# Programs of their own, in `make check`: what tests and benchmarks use, and all instruction sets at once.
TESTS_APART = oracle tasks plan_spheres processor
# Each file of tests; TESTS="mesh body": these alone, where each is a program of its own.
TESTS = $(patsubst tests/test_%.c,%,$(wildcard tests/test_*.c))
TEST_OBJECTS = build/main.o $(patsubst %,build/test_%.o,$(filter-out $(TESTS_APART),$(TESTS)))
# -std=c99 keeps gcc from fusing products and sums, and gnu99, which most users have, does not.
build/test_asks.o build/test_round.o: TEST_CFLAGS := $(filter-out -m%,$(TEST_CFLAGS)) -ffp-contract=fast

$(TEST_OBJECTS): build/%.o: tests/%.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(TEST_CFLAGS) -pthread -std=c99 $(TEST_WARNINGS) -c -o $@ $<
build/tests: $(TEST_OBJECTS)
	$(CC) $(TEST_CFLAGS) -pthread -o $@ $(TEST_OBJECTS) -lm

# On all processors: CORES=1 for one.
CORES ?= $(shell getconf _NPROCESSORS_ONLN 2>/dev/null || echo 2)
test:  ## builds and runs the test binary; the last line is `N passed, N failed`
	@$(MAKE) --no-print-directory $(if $(filter -j%,$(MAKEFLAGS)),,-j$(CORES)) build/tests
	@TEST_JOBS=$(CORES) build/tests

# Peers, generators and benchmarks.
BENCHES = $(patsubst tests/bench/%.c,build/%,$(wildcard tests/bench/*.c))
$(BENCHES): build/%: tests/bench/%.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(ALL_CFLAGS) -Wno-unused-function $(CCD_CFLAGS) -o $@ $< $(CCD_LIBS) -lm

# The planner with other checks than proofs: one call of its header goes elsewhere.
build/peers/neuralsvcd.h: $(LIBRARY) | build
	mkdir -p build/peers
	grep -c 'result = nsvcd_check(r->checker, motion' neuralsvcd.h | grep -qx 1
	sed 's/result = nsvcd_check(r->checker, motion/result = peer_check(r->checker, motion/' neuralsvcd.h >$@
build/route_peers: tests/bench/bench_routes.c build/peers/neuralsvcd.h $(HELPERS) $(PEERS) $(SCENERY) | build
	$(CC) $(ALL_CFLAGS) -Ibuild/peers -I. -DROUTE_PEERS -Wno-unused-function -o $@ $< -lm

check-rooms:  # each compiles by itself, with what it includes and nothing else
	CC="$(CC)" tests/rooms.sh
check-header: | build  # as C99 to C++17, strictly, and what it leaves in the namespace; as Microsoft's compiler would see it
	tests/msvc.sh
	CC="$(CC)" CXX="$(CXX)" tests/header.sh
check-examples: all build/make_assets  # they run, and they say no as examples/FORMATS.md demands
	tests/examples.sh
# What README holds, word by word (Debian: mmdebstrap); README_LINES=130: and how long it may be.
check-newcomer:  # README's commands on a bare Debian, one by one; and are mistakes in a README noticed?
	README_LINES=130 tests/newcomer.sh
	tests/newcomer.sh --mutants
check-packages:  # installed, found by pkg-config and CMake, as one file, in a project's folder
	+CC="$(CC)" tests/packages.sh
check-problems: build/problems build/svcd build/verify  # every set that the generator can make
	tests/bench/problems.sh

# The gradient, with each of these switches.
GRADIENT_SWITCHES = SIMD FLOAT INT8 BASE SMALL,BASE
build/gradient_%: tests/test_gradient.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS) -std=c99 $(TEST_WARNINGS) -DTEST_ALONE $(patsubst %,-DNSVCD_NO_%,$(subst $(comma), ,$*)) -o $@ $< -lm
check-gradient: $(GRADIENT_SWITCHES:%=build/gradient_%)  # the gradient, with each of the switches
	@for test in $^; do echo $$test; $$test >$$test.txt || { cat $$test.txt; exit 1; }; tail -1 $$test.txt; done

# The tests of the proof, alone.
build/test_proof: tests/test_proof.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS) -std=c99 $(TEST_WARNINGS) -DTEST_ALONE -o $@ $< -lm
# The same, and bodies, with tiles of two groups: those of more than 32 patches are searched tile by tile.
build/tiles_%: tests/test_%.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS) -std=c99 $(TEST_WARNINGS) -DNSVCD__TILE=2 -DTEST_ALONE -o $@ $< -lm
check-tiles: build/tiles_proof build/tiles_facets  # the proof, searched tile by tile
	@for test in $^; do echo $$test; $$test >$$test.txt || { cat $$test.txt; exit 1; }; tail -1 $$test.txt; done
# What refuses NaN and infinity does so on their bits, and so under -ffast-math as well; FILE/TESTS. The header warns there
# that results are not tested.
FAST = query/refuses motion/bad_poses proof/refuses mesh/mesh_is_checked mesh/refused encoding/refuses facets/refuses \
  body/malice gradient/refuses optimizer/refuses
build/fast_%: tests/test_%.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS) -I. -O1 -ffast-math -std=c99 -Wall -Wextra -Wno-unused-function -DNSVCD_NO_DISPATCH -DTEST_ALONE -o $@ $< -lm \
	  2>$@.txt && grep -q 'warning: neuralsvcd.h: -ffinite-math-only' $@.txt || { cat $@.txt; exit 1; }
check-fast-math: $(sort $(foreach test,$(FAST),build/fast_$(firstword $(subst /, ,$(test)))))  # NaN and infinity are refused under -ffast-math too
	@for test in $(FAST); do \
	  build/fast_$${test%/*} $${test#*/} >build/fast.txt || { cat build/fast.txt; exit 1; }; done; \
	  echo "fast-math: NaN and infinity are refused: $(FAST)"
check-levels: build/problems  # lanes and answers with AVX-512, AVX2, SSE2, NEON and without
	CC="$(CC)" tests/levels.sh
# On 32 bits, where sizes end at 4 GB, under sanitizers; where the compiler can (Debian: gcc-12-multilib; gcc-multilib does
# not go with compilers for other processors, and has no more but a link to <asm>, whose place -idirafter says).
CFLAGS_32 = -m32 -msse2 -mfpmath=sse -O1 -fsanitize=address,undefined -fno-sanitize-recover=all \
  -idirafter /usr/include/x86_64-linux-gnu
build/test_%_32: tests/test_%.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS_32) -pthread -std=c99 $(TEST_WARNINGS) -DTEST_ALONE -o $@ $< -lm
# And on x87, whose registers have more digits than memory (gnu99); constants too have more (c99).
CFLAGS_X87 = -m32 -mno-sse -mfpmath=387 -O1 -idirafter /usr/include/x86_64-linux-gnu
build/test_%_gnu99: tests/test_%.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS_X87) -std=gnu99 $(TEST_WARNINGS) -DTEST_ALONE -o $@ $< -lm
build/test_%_c99: tests/test_%.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS_X87) -std=c99 $(TEST_WARNINGS) -DTEST_ALONE -o $@ $< -lm
check-32:  # 32 bits, under sanitizers; x87
	@if echo 'int main(void) { return 0; }' | $(CC) $(CFLAGS_32) -x c -o build/can_32 - 2>/dev/null; then \
	  $(MAKE) build/test_level_32 build/test_optimizer_32 && build/test_level_32 && \
	  build/test_optimizer_32 plan_sizes && \
	  $(MAKE) build/test_facets_gnu99 build/test_facets_c99 && \
	  $(MAKE) build/test_checker_gnu99 build/test_certificate_gnu99 && \
	  (ulimit -t 300; build/test_facets_gnu99 && build/test_facets_c99 && build/test_checker_gnu99 && \
	    build/test_certificate_gnu99 certificates_are_true); \
	else echo "check-32: $(CC) has no libraries for -m32: not tested"; fi
# On Cortex-M4F and M7 under QEMU, where its tools are there (Debian: gcc-arm-none-eabi, libnewlib-arm-none-eabi,
# qemu-system-arm).
check-firmware: | build  # Cortex-M4F and M7, under QEMU
	$(MAKE) -C examples/firmware LEVELS=O2 run
	$(MAKE) -C examples/firmware LEVELS=Os BUILDS="proof network" run
firmware: | build  ## Cortex-M under QEMU: answers as on the host; flash, RAM, stack and instructions as a table
	$(MAKE) -C examples/firmware run table
# A page with the library as WebAssembly: clang, lld, wasi-libc, libclang-rt-14-dev-wasm32; and its test in a browser:
# chromium-driver, python3-selenium.
web:  ## build/web/index.html: drag a motion, drop files, see the answer; five scenes, an arm among them
	@$(MAKE) --no-print-directory -C examples/web page
check-web: build/svcd build/verify
	@$(MAKE) --no-print-directory -C examples/web check
# The module for Python, where there is one with numpy: Debian's numpy is for Debian's Python.
check-python:
	@for python in $(PYTHON) /usr/bin/python3; do \
	  $$python -c 'import numpy' 2>/dev/null || continue; \
	  $(MAKE) build/svcd build/_neuralsvcd.so build/_nsvcd_verify.so && cd examples/python && exec $$python -B -m unittest; exit 1; \
	done; echo "check-python: no python3 with numpy: not tested"
# The examples for Windows, where MinGW is there (Debian: gcc-mingw-w64-x86-64).
MINGW = x86_64-w64-mingw32-gcc
$(EXAMPLES:%=%.exe): build/%.exe: examples/%.c $(wildcard examples/*.h) $(SCENERY) $(LIBRARY) | build
	$(MINGW) -O0 -std=c99 $(WARNINGS) -Werror -Wno-unused-function $(if $(filter %/svcd.exe,$@),,-DNSVCD_NO_DISPATCH) -o $@ $< -lm
check-mingw:
	@if command -v $(MINGW) >/dev/null; then $(MAKE) $(EXAMPLES:%=%.exe); \
	else echo "check-mingw: no $(MINGW): not tested"; fi
# At random, in the whole header: MUTANTS=100 JOBS=16, PART=0 OF=4: every fourth, SEED.
mutate:  ## mistakes in the header at random: how many do the tests notice? MUTANTS=20 SEED=1 JOBS=1 PART=0 OF=1
	python3 tests/mutate.py --cc "$(CC)" --count $(or $(MUTANTS),20) --seed $(SEED) --jobs $(JOBS) \
	  --part $(or $(PART),0) --of $(or $(OF),1)
mutants:  ## the header with one mistake at a time: the tests of the proof must catch each; minutes
	CC="$(CC)" tests/mutants.sh

# Each file of tests as a program of its own, compiled otherwise: build/FLAVOUR/test_X; what it says is in
# build/FLAVOUR/test_X.txt, which is there when it has passed.
FLAGS_apart = $(if $(filter %processor,$@),$(filter-out -m%,$(TEST_CFLAGS)),$(TEST_CFLAGS))
SANITIZE_FLAGS = -fsanitize=address,undefined -fno-sanitize-recover=all
FLAGS_sanitized = -O1 -g $(SANITIZE_FLAGS)
FLAGS_threads = -O1 -g -fsanitize=thread
# Counted before anything is inlined or simplified: a branch is one of the text. Threads may lose a few counts,
# and what gcovr then finds below 0 is left out.
FLAGS_covered = -Og -fno-early-inlining -fprofile-update=single --coverage
define flavour
build/$(1)/test_%: tests/test_%.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY)
	@mkdir -p $$(@D) && rm -f $$@-*.gcda
	$$(CC) $$(FLAGS_$(1)) -pthread -std=c99 $$(TEST_WARNINGS) $$(CCD_CFLAGS) -DTEST_ALONE -o $$@ $$< $$(CCD_LIBS) -lm
build/$(1)/test_%.txt: build/$(1)/test_%
	@$$< $$(RUN_$(1)) >$$@.part 2>&1 || { grep -E 'ERROR|WARNING|runtime error|failed' $$@.part; echo "$$<: see $$@.part"; exit 1; }
	@mv $$@.part $$@ && echo "$$<: $$$$(tail -1 $$@)"
endef
$(foreach kind,apart sanitized threads covered,$(eval $(call flavour,$(kind))))
.PRECIOUS: $(TESTS:%=build/sanitized/test_%) $(TESTS:%=build/threads/test_%) $(TESTS:%=build/covered/test_%)
check-tools: $(patsubst %,build/apart/test_%.txt,$(filter-out processor,$(TESTS_APART)))  # the oracle and the planners that tests and benchmarks use
check-processor: build/apart/test_processor.txt  # SSE2, AVX2 and AVX-512 in one program: answers agree
check-exact: build/apart/test_exact  # 50,000 pairs of triangles at the edge against exact arithmetic; TEST_MANY=100: twice as many
	TEST_MANY=$(or $(TEST_MANY),50) build/apart/test_exact
can_link = $(shell echo 'int main(void) { return 0; }' | $(1) -x c - -o /dev/null 2>/dev/null && echo 1)

# The address and the undefined behaviour sanitizer; test_processor.c has what is for AVX2 and AVX-512 too.
SANITIZED = mesh body facets encoding query
sanitize = @$(if $(call can_link,$(CC) $(SANITIZE_FLAGS)),$(MAKE) $(1:%=build/sanitized/test_%.txt),\
	  echo "check-sanitizers: $(CC) has no sanitizers: not tested")
check-sanitizers:  # five files of tests under the address and undefined behaviour sanitizers
	$(call sanitize,$(SANITIZED))
check-sanitizers-all:  # all of them
	$(call sanitize,$(TESTS))
# The thread sanitizer, where threads share bodies: tests whose names contain this.
RUN_threads = threads
THREADED = $(patsubst tests/test_%.c,%,$(shell grep -l 'RUN.*$(RUN_threads)' tests/test_*.c))
check-threads:  # threads that share bodies, under the thread sanitizer
	@$(if $(call can_link,$(CC) -fsanitize=thread),$(MAKE) $(THREADED:%=build/threads/test_%.txt),\
	  echo "check-threads: $(CC) has no thread sanitizer: not tested")
# On other processors, under QEMU: ARCHS="aarch64 s390x" (Debian: qemu-user, gcc-aarch64-linux-gnu, gcc-arm-linux-gnueabihf,
# gcc-riscv64-linux-gnu, gcc-powerpc64le-linux-gnu, gcc-s390x-linux-gnu, and libc6-dev-ARCH-cross of each).
check-cross:  # aarch64, armhf, riscv64, ppc64le, s390x, under QEMU
	CC="$(CC)" tests/cross.sh $(ARCHS)

# Inputs at random, under sanitizers where the compiler has them: tests/fuzz/main.h says how a target is run by itself.
FUZZ_TARGETS = $(filter-out library,$(patsubst tests/fuzz/%.c,%,$(wildcard tests/fuzz/*.c)))
FUZZ_CFLAGS = -O1 -g -std=c99 $(TEST_WARNINGS)
SANITIZE = $(if $(call can_link,$(CC) $(SANITIZE_FLAGS)),$(SANITIZE_FLAGS))
FUZZ_HEADERS = $(wildcard tests/fuzz/*.h) tests/failing_heap.h $(SCENERY)
build/fuzz/library.o: tests/fuzz/library.c $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(FUZZ_CFLAGS) $(SANITIZE) -c -o $@ $<
$(FUZZ_TARGETS:%=build/fuzz/%): build/fuzz/%: tests/fuzz/%.c build/fuzz/library.o $(FUZZ_HEADERS) neuralsvcd.h
	$(CC) $(FUZZ_CFLAGS) $(SANITIZE) -o $@ $< build/fuzz/library.o -lm
check-fuzz: $(FUZZ_TARGETS:%=build/fuzz/%)  # the corpora of the fuzz targets, under sanitizers
	@for target in $(FUZZ_TARGETS); do \
	  build/fuzz/$$target --out build/fuzz/$$target.crash tests/fuzz/corpus/$$target || exit 1; done

# The same with libFuzzer, of clang.
FUZZ_CLANG = clang
LIBFUZZER_FLAGS = -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=all -DFUZZ_LIBFUZZER
build/libfuzzer/library.o: tests/fuzz/library.c $(LIBRARY)
	@mkdir -p $(@D)
	$(FUZZ_CLANG) $(FUZZ_CFLAGS) $(LIBFUZZER_FLAGS) -c -o $@ $<
$(FUZZ_TARGETS:%=build/libfuzzer/%): build/libfuzzer/%: tests/fuzz/%.c build/libfuzzer/library.o $(FUZZ_HEADERS) neuralsvcd.h
	$(FUZZ_CLANG) $(FUZZ_CFLAGS) $(LIBFUZZER_FLAGS) -fsanitize=fuzzer -o $@ $< build/libfuzzer/library.o -lm
# TARGET=obj: one of them alone. SECONDS, JOBS (processes of each target), SEED; PLAIN=1: without libFuzzer.
SECONDS = 60
JOBS = 1
SEED = 1
FUZZED = $(or $(TARGET),$(FUZZ_TARGETS))
HAVE_LIBFUZZER = $(if $(PLAIN),,$(call can_link,$(FUZZ_CLANG) -fsanitize=fuzzer-no-link$(comma)address$(comma)undefined))
fuzz:  ## inputs at random for a minute each: TARGET=obj SECONDS=600 JOBS=2 SEED=1
	@kind=$(if $(HAVE_LIBFUZZER),libfuzzer,fuzz); \
	$(MAKE) $(FUZZED:%=build/$$kind/%) && tests/fuzz/run.sh $$kind $(SECONDS) $(JOBS) $(SEED) $(FUZZED)

# What moving things ask, against conservative advancement in double: pairs of the game, and with MOTIONS="FILE ..." problem
# files; FIRST: tolerance of first contacts, a share of the motion. FRAMES=1000 for more.
FRAMES = 60
FIRST = 0.01
check-motions:  ## first contacts, clearances and two movers against an oracle
check-motions: build/check_motions build/game build/problems build/svcd
	@mkdir -p build/motions
	build/problems --set standard --meshes procedural --count 100 --seed 407 --out build/motions/standard.txt
	build/check_motions build/motions/standard.txt 0 $(FIRST)
	@! command -v python3 >/dev/null || { \
	  python3 tests/bench/carry.py build/motions/standard.txt build/motions/carried.txt && \
	  build/check_motions build/motions/carried.txt 0 $(FIRST) && \
	  build/svcd check --repeat 1 build/motions/carried.txt 2>&1 >/dev/null | grep '^accuracy *100.00'; }
	build/game --frames $(FRAMES) --problems build/motions
	build/check_motions build/motions/game.txt 0.002 $(FIRST)
	@for file in $(MOTIONS); do echo $$file; build/check_motions $$file 0 $(FIRST) || exit 1; done

# SCENES=2000 for more, SEED=7 for others.
SCENES = 60
# Asked both ways, with products fused into sums and without.
build/check_options_fused: CFLAGS += -ffp-contract=fast
build/check_options_fused: tests/bench/check_options.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(ALL_CFLAGS) -Wno-unused-function -o $@ $< -lm
check-options: build/check_options build/check_options_fused  # every option against every other, and against distances
	@mkdir -p build/options && tar xzf examples/scenery/meshes/random_urdfs.tar.gz -C build/options
	@for made in $^; do echo $$made; \
	  $$made $(SCENES) $(SEED) build/options/random_urdfs/[0-4]*.obj >$$made.txt; status=$$?; \
	  sed -n '/^ answers/,$$p' $$made.txt; [ $$status = 0 ] || exit 1; done

# ROBOTS=2000 for more.
ROBOTS = 60
check-robots: build/check_robots  # motions of random robots against distances in double
	build/check_robots $(ROBOTS) $(SEED)

# RESTING=10000 for more.
RESTING = 300
check-rest: build/check_rest  # what lies flat on a table: depth, lift, safe place and manifold against its own vertices
	@mkdir -p build/options && tar xzf examples/scenery/meshes/random_urdfs.tar.gz -C build/options
	build/check_rest $(RESTING) $(or $(SEED),1) build/options/random_urdfs/*.obj

# FLOORED=1000 for more questions a floor.
FLOORED = 100
check-extremes: build/problems build/svcd build/check_floors  # tiny, huge, far, thin, spinning; large floors; a table of what is decided
	tests/bench/extremes.sh
	@mkdir -p build/options && tar xzf examples/scenery/meshes/random_urdfs.tar.gz -C build/options
	build/check_floors $(FLOORED) build/options/random_urdfs/*[05].obj

check-one-path:  # NSVCD_ONE_PATH: the same bits from several compilers, sets of instructions, and under QEMU and node
	CC="$(CC)" tests/one_path.sh

# What a change must pass beside `make test`, within 25 minutes on two cores; and what a release must: CONTRIBUTING.md says
# what each catches. Programs that several of them use are made first, so that no two make the same file at once.
CHECKS = text rooms header examples newcomer tools processor fast-math levels exact extremes motions sanitizers fuzz python trainer benches
RELEASE = packages gradient tiles many 32 options robots rest one-path problems threads cross mingw firmware web sanitizers-all mutants
CHECKED = build/svcd build/verify $(DEMOS) build/make_assets build/problems build/check_motions build/check_rest
check:  ## what else a change must pass; the last line is `N passed, N failed, N skipped`; ONLY="text rooms"
	@$(if $(filter 1,$(words $(ONLY))),,$(MAKE) --no-print-directory -j$(CORES) $(CHECKED))
	@MAKE="$(MAKE)" tests/check.sh $(CORES) $(or $(ONLY),$(CHECKS))
check-release:  ## all of that, and what takes hours, or tools that few have
	@$(MAKE) --no-print-directory -j$(CORES) $(CHECKED)
	@MAKE="$(MAKE)" tests/check.sh $(CORES) $(or $(ONLY),$(CHECKS) $(RELEASE))
.PHONY: $(addprefix check-,$(CHECKS) $(RELEASE))
check-many: build/tests  # the tests, five times as many trials each
	TEST_MANY=5 build/tests
build/benches/%: tests/bench/%.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) -O0 -DNSVCD_NO_DISPATCH -std=c99 $(WARNINGS) -Werror -Wno-unused-function $(CCD_CFLAGS) -o $@ $< $(CCD_LIBS) -lm
check-benches: $(BENCHES:build/%=build/benches/%)  # benchmarks and generators compile, without a warning
	@echo "benches: $(notdir $^)"
check-trainer:  # the trainer's own tests, on the CPU
	@for python in $(PYTHON) /usr/bin/python3; do \
	  $$python -c 'import torch' 2>/dev/null || continue; cd train && exec $$python -m unittest; exit 1; \
	done; echo "check-trainer: no python3 with torch: not tested"
check-mutants: mutants  # mistakes made on purpose in the proof: do its tests catch each?

# Lines and branches of src/ that the tests reach, and those lines that they do not (Debian: gcovr). With -j16 some
# minutes. So many are demanded, per cent.
COVERED_LINES = 97
COVERED_BRANCHES = 95
# Functions that no test calls are in no test's program: they are counted where all of the header is.
build/covered/library.o: $(ROOMS) weights.h
	@mkdir -p $(@D)
	printf '#define NEURALSVCD_IMPLEMENTATION\n#include "src/header.h"\n' >build/covered/library.c
	$(CC) $(FLAGS_covered) -std=c99 $(TEST_WARNINGS) -c -o $@ build/covered/library.c
coverage:  ## what the tests reach of the rooms; make -j16, minutes
	@if command -v gcovr >/dev/null; then \
	  $(MAKE) build/covered/library.o $(TESTS:%=build/covered/test_%.txt) && gcovr --root . --filter src/ \
	    --gcov-ignore-parse-errors --txt --print-summary --fail-under-line $(COVERED_LINES) --fail-under-branch $(COVERED_BRANCHES) build/covered; \
	else echo "coverage: no gcovr: not tested"; fi

# ---------------------------------------------------------------------------------------------------------- accuracy

problems: build/problems  ## the generator of exactly labelled problems

# Real meshes: a folder of sets, each an archive NAME.tar.gz or a folder NAME of OBJ files. Without it a small sample, which
# is in the repository.
MESHES ?=
MESH_SETS = $(or $(MESHES),examples/scenery/meshes)
FOUND = $(patsubst %.tar.gz,%,$(notdir $(wildcard $(MESH_SETS)/*.tar.gz))) \
  $(notdir $(patsubst %/,%,$(wildcard $(MESH_SETS)/*/)))
REAL = $(strip $(filter random_urdfs,$(FOUND)) $(filter metaworld,$(FOUND)) \
  $(sort $(filter-out random_urdfs metaworld,$(FOUND))))
# What bodies do where they touch, from this set.
AT_REST = $(firstword $(REAL))

# The problem sets: what is made up lies in DATA, what is made of real meshes in REAL_DATA. COUNT=200 for a quick look.
# Labelling takes minutes.
DATA = build/accuracy$(if $(COUNT),_$(COUNT))
REAL_DATA = $(if $(MESHES),$(DATA),build/sample$(if $(COUNT),_$(COUNT)))
HARD = rest nested same one soup slivers
MADE_UP = standard hollow inside $(HARD)
OF_REAL = $(if $(filter metaworld,$(REAL)),open) $(if $(REAL),rest_real large)
SETS = standard hollow inside $(REAL) $(filter open,$(OF_REAL)) $(HARD) $(filter-out open,$(OF_REAL))
# $(call files,NAMES): the problem files of these sets.
files = $(foreach set,$(1),$(if $(filter $(set),$(MADE_UP)),$(DATA),$(REAL_DATA))/$(set).txt)

# The seeds and counts of the measured accuracy; of real meshes 2,000, seed 410, where nothing else is said.
SEED_standard = 401
SEED_hollow = 404
SEED_inside = 405
SEED_random_urdfs = 402
SEED_metaworld = 403
COUNT_standard = 4000
COUNT_hollow = 1000
COUNT_inside = 400
COUNT_open = 500
COUNT_large = 1000
COUNT_rest = 2000
COUNT_rest_real = 2000
COUNT_nested = 1000
COUNT_same = 1000
COUNT_one = 1000
COUNT_soup = 500
COUNT_slivers = 300
CHECK_FLAGS =

# $(call label,SET,MESHES,COUNT,SEED)
label = mkdir -p $(@D) && build/problems --set $(1) --meshes $(2) --count $(or $(COUNT),$(3)) --seed $(4) --out $@
$(MADE_UP:%=$(DATA)/%.txt): $(DATA)/%.txt: | build/problems
	$(call label,$*,procedural,$(COUNT_$*),$(or $(SEED_$*),407))
$(REAL:%=$(REAL_DATA)/%.txt): $(REAL_DATA)/%.txt: $(REAL_DATA)/meshes/% | build/problems
	$(call label,standard,$<,$(or $(COUNT_$*),2000),$(or $(SEED_$*),410))
$(REAL_DATA)/open.txt: $(REAL_DATA)/meshes/metaworld | build/problems  # meshes that are not closed
	$(call label,standard,$< --open only,$(COUNT_open),406)
$(REAL_DATA)/rest_real.txt: $(REAL_DATA)/meshes/$(AT_REST) | build/problems
	$(call label,rest,$<,$(COUNT_rest_real),408)
$(REAL_DATA)/large.txt: $(REAL_DATA)/meshes/large | build/problems  # closed meshes of 1,500 triangles and more
	$(call label,standard,$<,$(COUNT_large),409)
$(REAL_DATA)/meshes/large: $(REAL:%=$(REAL_DATA)/meshes/%)
	rm -rf $@.part && mkdir -p $@.part
	for mesh in $(^:%=%/*.obj); do [ `grep -c '^f' $$mesh` -lt 1500 ] || cp $$mesh $@.part/; done
	mv $@.part $@
# All OBJ files of an archive or a folder, flat.
$(REAL:%=$(REAL_DATA)/meshes/%): $(REAL_DATA)/meshes/%:
	rm -rf $@.part && mkdir -p $@.part/all
	if test -d $(MESH_SETS)/$*; then cp -r $(MESH_SETS)/$*/. $@.part/all; \
	else tar xzf $(MESH_SETS)/$*.tar.gz -C $@.part/all; fi
	find $@.part/all -name '*.obj' -exec mv -n {} $@.part/ \;
	rm -rf $@.part/all && mv $@.part $@

accuracy: build/svcd $(call files,$(SETS))  ## labels the problem sets (minutes, kept) and measures on each
	@for file in $(call files,$(SETS)); do echo; \
	  build/svcd check $(CHECK_FLAGS) $$file >$${file%.txt}.tsv || exit 1; done

# --------------------------------------------------------------------------------------------------------- benchmark

# Sets at the extremes: 300 problems each, answered by NeuralSVCD alone.
EXTREMES = thin spin still tiny huge inside cavity far mixed offset
build/extremes/%.txt: | build/problems
	@mkdir -p build/extremes
	build/problems --set $* --meshes procedural --count 300 --seed 501 --out $@
.PRECIOUS: build/extremes/%.txt

comma := ,
space := $(subst x,,x x)
# BENCH=quick: fewer settings on 200 problems a set, two minutes. PROBLEMS=file: your own problems instead.
ifdef PROBLEMS
BENCH_SETS = $(basename $(notdir $(PROBLEMS)))=$(PROBLEMS)
else
BENCH_REAL = $(call files,$(or $(REAL),standard))
BENCH_REST = $(call files,$(or $(filter rest_real,$(OF_REAL)),rest))
BENCH_SETS = $(if $(REAL),real,standard)=$(subst $(space),$(comma),$(strip $(BENCH_REAL))) \
  hollow=$(DATA)/hollow.txt rest=$(BENCH_REST) \
  $(if $(BENCH),,$(foreach set,$(EXTREMES),$(set)=build/extremes/$(set).txt))
BENCH_FILES = $(BENCH_REAL) $(DATA)/hollow.txt $(BENCH_REST) $(if $(BENCH),,$(EXTREMES:%=build/extremes/%.txt))
endif

bench: build/bench $(BENCH_FILES)  ## every method on the same problems: table, build/tradeoff.tsv, build/tradeoff.svg
	build/bench $(if $(BENCH),--quick --limit 150,--limit 600) $(BENCH_SETS)

# The proof, the network's default and the mesh hierarchy on all sets, in one run: for ratios.
RACE = standard $(filter-out rest,$(HARD)) $(filter large,$(OF_REAL))
race: build/bench $(BENCH_FILES) $(call files,$(RACE))  ## the proof against the hierarchy and the network, minutes
	build/bench --race --out build/race $(if $(LIMIT),--limit $(LIMIT)) $(BENCH_SETS) \
	  $(foreach set,$(RACE),$(set)=$(call files,$(set)))

bench-scale: build/bench_scale  ## bytes and microseconds against triangles and against N: table, build/scale.svg
	build/bench_scale
ASKED = $(call files,standard hollow rest)
bench-distance: build/bench_distance $(ASKED)  ## the network's distance and its gradient against exact margins
	build/bench_distance $(ASKED)
bench-level: build/bench_level  ## a level of 20 m as one body: encoding, memory, and motions of a frame
	for n in 20000 60000 200000 1000000; do build/bench_level $$n $(or $(LEVEL_MOTIONS),200) || exit 1; done
bench-certificates: build/bench_certificates $(call files,$(SETS))  ## bytes and milliseconds of certificates, on all sets
	build/bench_certificates $(call files,$(SETS))
bench-one-path:  ## what NSVCD_ONE_PATH costs
	CC="$(CC)" tests/one_path.sh time
bench-casts: build/bench_casts  ## capsules, spheres and rays in a level; clouds
	build/bench_casts
bench-asks: build/bench_asks build/game $(ASKED)  ## what first contacts, clearances and skins cost
	@mkdir -p build/motions
	build/game --frames 300 --problems build/motions
	build/bench_asks build/motions/game.txt 0.002
	for file in $(ASKED); do build/bench_asks $$file || exit 1; done
# EPISODES=10 for a quick look; 100, the default, take half an hour.
bench-plan: build/plan_bench  ## four planners on three tasks: table, build/plan.tsv, build/plan.svg
	build/plan_bench --episodes $(or $(EPISODES),100) --tsv build/plan.tsv
	build/plan_bench chart build/plan.tsv build/plan.svg

TIMED = $(REAL_DATA)/$(AT_REST).txt
profile: build/profile $(TIMED) $(call files,hollow rest)  ## where a query's time goes, stage by stage
	build/profile $(TIMED) 64 128 512
	build/profile $(DATA)/hollow.txt 512
	build/profile $(DATA)/rest.txt 256
instructions: $(TIMED)  ## what a query executes, counted by callgrind
	CC="$(CC)" tests/bench/instructions.sh $(TIMED) 64 512
bench-flags: build/problems $(call files,standard hollow rest)  ## -O2 against -O3 -march=native; ALL=1: more builds
	CC="$(CC)" ALL="$(ALL)" tests/bench/flags.sh $(call files,standard hollow rest)
sizes:  ## code and data that each compile-time switch leaves out, host and Cortex-M
	CC="$(CC)" tests/bench/sizes.sh

# ---------------------------------------------------------------------------------------------------------- training

# The recipe of the shipped weights: train/README.md. CHECKPOINT=file skips the training.
CHECKPOINT = build/train/checkpoint.pt
PYTHON ?= python3
CALIBRATION = build/calibration

build/scenes: train/scenes.c tests/bench/set_shapes.h $(LIBRARY)
	@mkdir -p build
	$(CC) -O3 -march=native -std=gnu99 -Wall -Wextra -Wno-unused-function -o $@ $< -lm -lpthread
build/train/checkpoint.pt: | build/scenes
	mkdir -p build/train/set build/train/held
	build/scenes build/train/set --seed 1 --meshes 20000 --groups 4600 --threads $$(nproc)
	build/scenes build/train/held --seed 2 --meshes 600 --groups 32 --threads $$(nproc)
	cd train && $(PYTHON) train.py --data ../build/train/set --held ../build/train/held --out ../build/train --steps 50038
# Sets as SET:COUNT:SEED.
CALIBRATES = standard:4000:301 hollow:3000:302 rest:2000:303 cavity:1000:304
CALIBRATED = $(foreach set,$(CALIBRATES),$(CALIBRATION)/$(firstword $(subst :, ,$(set))).txt)
$(CALIBRATED): | build/problems
	@mkdir -p $(CALIBRATION)
	set=$(filter $(basename $(@F)):%,$(CALIBRATES)); rest=$${set#*:}; build/problems --set $${set%%:*} \
	  --meshes procedural --count $${rest%:*} --seed $${rest#*:} --out $@
.PRECIOUS: $(CALIBRATION)/%.txt

weights: $(CHECKPOINT) $(CALIBRATED)  ## trains anew on a GPU, calibrates, writes weights.h
	cd train && $(PYTHON) export.py ../$(CHECKPOINT) ../weights.h ../tests/data/golden.h uncalibrated
	$(MAKE) build/svcd
	cd train && $(PYTHON) calibrate.py ../$(CHECKPOINT) ../build/svcd $(CALIBRATED:%=../%)
	cd train && $(PYTHON) export.py ../$(CHECKPOINT) ../weights.h ../tests/data/golden.h

WRITTEN = train examples examples/scenery examples/svcd examples/firmware examples/python examples/verify examples/web packages/project tests tests/bench
FORMATTED = $(ROOMS) $(wildcard $(WRITTEN:%=%/*.[ch]))
format:  ## clang-format on what is written by hand
	clang-format -i $(FORMATTED)
# Version 14 decides, as in Debian 12: others break lines elsewhere.
check-text:  ## the rooms as a text; that neuralsvcd.h is made of them, the tests of tests/PROMISES.md are there, mutants can be made, all is formatted
	@if command -v python3 >/dev/null; then python3 src/make_header.py --check && python3 tests/make_header_test.py && \
	  python3 tests/make_api_test.py && python3 tests/text.py && python3 tests/promises.py && \
	  DRY=1 WORK=build/mutants_dry tests/mutants.sh >/dev/null; \
	else echo "check-text: no python3: not tested"; fi
	@if clang-format --version 2>/dev/null | grep -q 'version 14'; then \
	  clang-format --dry-run -Werror $(FORMATTED); \
	else echo "check-text: no clang-format 14: format not tested"; fi

clean:  ## removes build/
	rm -rf build
