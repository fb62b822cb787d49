# Included by the Makefile: `make check`, `make check-release`, and the checks that they run.

# What a change must pass beside `make test`, within 25 minutes on two cores; and what a release must: CONTRIBUTING.md says
# what each catches. Programs that several of them use are made first, so that no two make the same file at once.
CHECKS = text rooms header examples newcomer tools processor fast-math levels exact extremes motions sanitizers fuzz python bindings trainer benches formal trajectory
RELEASE = packages formal-all gradient tiles many 32 options robots rest one-path problems threads cross mingw firmware web sanitizers-all mutants
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
build/benches/world_peers: tests/bench/world_peers.cc tests/bench/bench_world.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY)
	@mkdir -p $(@D)
	$(CXX) -O0 -DNSVCD_NO_DISPATCH -std=c++11 $(WARNINGS) -Werror -Wno-unused-function $(BULLET_CFLAGS) -o $@ $< $(BULLET_LIBS) -lm
check-benches: $(BENCHES:build/%=build/benches/%) $(if $(HAVE_BULLET),build/benches/world_peers)  # benchmarks and generators compile, without a warning
	@echo "benches: $(notdir $^)"
check-trainer:  # the trainer's own tests, on the CPU
	@for python in $(PYTHON) /usr/bin/python3; do \
	  $$python -c 'import torch' 2>/dev/null || continue; cd train && exec $$python -m unittest; exit 1; \
	done; echo "check-trainer: no python3 with torch: not tested"
check-mutants: mutants  # mistakes made on purpose in the proof: do its tests catch each?

check-rooms:  # each compiles by itself, with what it includes and nothing else
	CC="$(CC)" tests/rooms.sh
check-header: | build  # as C99 to C++17, strictly, and what it leaves in the namespace; as Microsoft's compiler would see it
	tests/msvc.sh
	CC="$(CC)" CXX="$(CXX)" tests/header.sh
check-examples: all build/make_assets  # they run, and they say no as examples/FORMATS.md demands
	tests/examples.sh
# What README holds, word by word (Debian: mmdebstrap); README_LINES=110: and how long it may be.
check-newcomer:  # README's commands on a bare Debian, one by one; and are mistakes in a README noticed?
	README_LINES=110 tests/newcomer.sh
	tests/newcomer.sh --mutants
check-packages:  # installed, found by pkg-config and CMake, as one file, in a project's folder
	+CC="$(CC)" tests/packages.sh
check-problems: build/problems build/svcd build/verify  # every set that the generator can make
	tests/bench/problems.sh

check-formal:  # the certificate's theorem, in Coq; its checker and build/verify say the same; bounds of roundings
	@FORMAL_SETS="standard hollow thin spin" formal/check.sh && formal/margins.sh
check-formal-all: formal  # of all sets; and that the checker's functions have no runtime error

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
FAST = promises_queries/refused promises_bodies/cannot_be test_query/refuses test_mesh/refused test_gradient/refuses \
  test_optimizer/refuses test_body/malice promises_bodies/scaled
FAST_CFLAGS = $(CFLAGS) -I. -O1 -ffast-math -std=c99 -Wall -Wextra -Wno-unused-function -DNSVCD_NO_DISPATCH -pthread
says_fast = 2>$@.txt && grep -q 'warning: neuralsvcd.h: -ffinite-math-only' $@.txt || { cat $@.txt; exit 1; }
build/fast_library.o: packages/neuralsvcd.c $(LIBRARY) | build
	$(CC) $(FAST_CFLAGS) -c -o $@ $< $(says_fast)
build/fast_promises_%: tests/promises/%.c build/fast_library.o $(PROMISE_HELPERS)
	$(CC) $(FAST_CFLAGS) -w -DTEST_ALONE -o $@ $< build/fast_library.o -lm
build/fast_test_%: tests/test_%.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(FAST_CFLAGS) -DTEST_ALONE -o $@ $< -lm $(says_fast)
check-fast-math: $(sort $(foreach test,$(FAST),build/fast_$(firstword $(subst /, ,$(test)))))  # NaN and infinity are refused under -ffast-math too
	@for test in $(FAST); do \
	  build/fast_$${test%/*} $${test#*/} >build/fast.txt || { cat build/fast.txt; exit 1; }; done; \
	  echo "fast-math: NaN and infinity are refused: $(FAST)"
check-levels: build/problems  # lanes and answers with AVX-512, AVX2, SSE2, NEON and without
	CC="$(CC)" tests/levels.sh
# On x87, whose registers have more digits than memory (gnu99); constants too have more (c99).
CFLAGS_X87 = -m32 -mno-sse -mfpmath=387 -O1 -idirafter /usr/include/x86_64-linux-gnu
build/test_%_gnu99: tests/test_%.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS_X87) -std=gnu99 $(TEST_WARNINGS) -DTEST_ALONE -o $@ $< -lm
build/test_%_c99: tests/test_%.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS_X87) -std=c99 $(TEST_WARNINGS) -DTEST_ALONE -o $@ $< -lm
# On 32 bits, where sizes end at 4 GB, under sanitizers; where the compiler can (Debian: gcc-12-multilib; gcc-multilib does
# not go with compilers for other processors, and has no more but a link to <asm>, whose place -idirafter says).
check-32:  # 32 bits, under sanitizers; x87
	@if $(if $(call can_link,$(CC) $(CFLAGS_32)),true,false); then \
	  $(MAKE) $(PROMISES:%=build/32/%.txt) build/32/test_level.txt build/32/test_optimizer && \
	  build/32/test_optimizer plan_sizes && \
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
	+tests/firmware.sh
	+tests/ways.sh firmware
firmware: | build  ## Cortex-M under QEMU: answers as on the host; flash, RAM, stack and instructions as a table
	$(MAKE) -C examples/firmware run table
# A page with the library as WebAssembly: clang, lld, wasi-libc, libclang-rt-14-dev-wasm32; and its test in a browser:
# chromium-driver, python3-selenium.
web:  ## build/web/index.html: drag a motion, drop files, see the answer; five scenes, an arm among them
	@$(MAKE) --no-print-directory -C examples/web page
check-web: build/svcd build/verify
	@$(MAKE) --no-print-directory -C examples/web check
	+tests/ways.sh page
# The module for Python, where there is one with numpy: Debian's numpy is for Debian's Python.
check-python:
	@for python in $(PYTHON) /usr/bin/python3; do \
	  $$python -c 'import numpy' 2>/dev/null || continue; \
	  command -v mypy >/dev/null || echo "check-python: no mypy: types not tested"; \
	  $$python -c 'import matplotlib' 2>/dev/null || echo "check-python: no matplotlib: pictures not tested"; \
	  $(MAKE) build/svcd build/_neuralsvcd.so build/_nsvcd_verify.so && (cd examples/python && exec $$python -B -m unittest) && exec tests/ways.sh python; exit 1; \
	done; echo "check-python: no python3 with numpy: not tested"
# Each way, once, as a table: packages/README.md has what this says.
ways: npm crate web  ## each way to a first verdict on one's own meshes, word by word by its README: seconds and bytes
	+tests/ways.sh
.PHONY: ways
check-bindings:  # the packages for npm and crates.io: made, installed, tested; and as their READMEs say
	+CC="$(CC)" tests/bindings.sh
	+tests/ways.sh npm rust
	+tests/ways.sh --mutants
# The examples for Windows, where MinGW is there (Debian: gcc-mingw-w64-x86-64).
MINGW = x86_64-w64-mingw32-gcc
$(EXAMPLES:%=%.exe): build/%.exe: examples/%.c $(wildcard examples/*.h) $(SCENERY) $(LIBRARY) | build
	$(MINGW) -O0 -std=c99 $(WARNINGS) -Werror -Wno-unused-function $(if $(filter %/svcd.exe,$@),,-DNSVCD_NO_DISPATCH) -o $@ $< -lm
check-mingw:
	@if command -v $(MINGW) >/dev/null; then $(MAKE) $(EXAMPLES:%=%.exe); \
	else echo "check-mingw: no $(MINGW): not tested"; fi

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

WRITTEN = train examples examples/scenery examples/svcd examples/firmware examples/python examples/verify examples/web packages/npm packages/project packages/rust/src packages/trajectory tests tests/promises tests/bench
FORMATTED = $(ROOMS) $(wildcard $(WRITTEN:%=%/*.[ch]) tests/bench/*.cc packages/trajectory/*pp)
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
