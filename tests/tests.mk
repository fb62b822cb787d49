# Included by the Makefile: the test binary, each file of tests as a program of its own, compiled in
# other ways, and what the tests reach and notice.
HELPERS = $(wildcard tests/*.h tests/data/*.h) $(ROOMS) $(VERIFIER)
PEERS = $(wildcard tests/bench/*.h)
# Each test file holds the rooms of src/ that it is about, test_asks.c, test_round.c, test_exact.c, test_floor.c and test_processor.c the
# header as users have it, and uses only a part of their private functions. One instruction set is enough for most: test_processor.c has all that the processor knows,
# whatever the flags.
TEST_WARNINGS = -I. -Wall -Wextra -Werror -Wno-unused-function -DNSVCD_NO_DISPATCH
# Tests take less time to compile than -O3 costs: both together decide. At -O1 gcc leaves the upper halves of wide
# registers in use, and on some processors libm's functions then take up to 40 times as long: one test 102 s for 2.5.
# What that option warns of then is false: with -O3 gcc does not. Small functions inlined are a sixth of the run for 7 % of the
# compilation.
ABOVE_O1 := $(shell echo | $(CC) -Werror -fexpensive-optimizations -finline-small-functions -E - >/dev/null 2>&1 && \
  echo -fexpensive-optimizations -finline-small-functions -Wno-maybe-uninitialized)
TEST_CFLAGS = $(CFLAGS:-O3=-O1) $(ABOVE_O1)
# Programs of their own, in `make check`: what tests and benchmarks use, and all instruction sets at once.
TESTS_APART = oracle tasks plan_spheres processor
# Each file of tests; TESTS="mesh body": these alone, where each is a program of its own, and with them the promises.
TESTS = $(patsubst tests/test_%.c,%,$(wildcard tests/test_*.c))
PROMISES = $(patsubst tests/promises/%.c,promises_%,$(wildcard tests/promises/*.c))
PROMISE_HELPERS = $(wildcard tests/promises/*.h) tests/check.h $(VERIFIER)
ALL_TESTS = $(TESTS:%=test_%) $(PROMISES)
TEST_OBJECTS = build/main.o $(patsubst %,build/test_%.o,$(filter-out $(TESTS_APART),$(TESTS)))
# -std=c99 keeps gcc from fusing products and sums, and gnu99, which most users have, does not, where the processor can.
FUSES := $(shell grep -qsw fma /proc/cpuinfo && echo -mfma) -ffp-contract=fast
build/test_asks.o build/test_round.o: TEST_CFLAGS := $(filter-out -m%,$(TEST_CFLAGS)) $(FUSES)

$(TEST_OBJECTS): build/%.o: tests/%.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(TEST_CFLAGS) -pthread -std=c99 $(TEST_WARNINGS) -c -o $@ $<
# The promises of the public contracts are linked to the library, as a program is.
$(PROMISES:%=build/%.o): build/promises_%.o: tests/promises/%.c $(PROMISE_HELPERS) $(LIBRARY) | build
	$(CC) $(TEST_CFLAGS) -pthread -std=c99 $(TEST_WARNINGS) -c -o $@ $<
build/tests: $(TEST_OBJECTS) $(PROMISES:%=build/%.o) build/library.o
	$(CC) $(TEST_CFLAGS) -pthread -o $@ $^ -lm

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
build/peers/neuralsvcd_robot.h: $(LIBRARY) | build
	mkdir -p build/peers
	grep -c 'result = nsvcd_check(r->checker, motion' extras/neuralsvcd_robot.h | grep -qx 1
	sed 's/result = nsvcd_check(r->checker, motion/result = peer_check(r->checker, motion/' extras/neuralsvcd_robot.h >$@
build/route_peers: tests/bench/bench_routes.c build/peers/neuralsvcd_robot.h $(HELPERS) $(PEERS) $(SCENERY) | build
	$(CC) $(ALL_CFLAGS) -Ibuild -I. -DROUTE_PEERS -Wno-unused-function -o $@ $< -lm

# Each file of tests as a program of its own, compiled otherwise: build/FLAVOUR/test_X; what it says is in
# build/FLAVOUR/test_X.txt, which is there when it has passed.
FLAGS_apart = $(if $(filter %processor,$@),$(filter-out -m%,$(TEST_CFLAGS)),$(TEST_CFLAGS))
SANITIZE_FLAGS = -fsanitize=address,undefined -fno-sanitize-recover=all
FLAGS_sanitized = -O1 -g $(SANITIZE_FLAGS)
FLAGS_threads = -O1 -g -fsanitize=thread
# Counted before anything is inlined or simplified: a branch is one of the text. Threads may lose a few counts,
# and what gcovr then finds below 0 is left out.
FLAGS_covered = -Og -fno-early-inlining -fprofile-update=single --coverage
CFLAGS_32 = -m32 -msse2 -mfpmath=sse -O1 $(SANITIZE_FLAGS) -idirafter /usr/include/x86_64-linux-gnu
FLAGS_32 = $(CFLAGS_32)
# What the promises are linked to; to count the rooms' lines, the library is compiled from the rooms.
build/library_of_rooms.c: packages/neuralsvcd.c | build
	sed 's|"neuralsvcd.h"|"src/header.h"|; s|"extras/neuralsvcd_|"src/|' $< >$@
SOURCE_covered = build/library_of_rooms.c
define flavour
build/$(1)/library.o: $(or $(SOURCE_$(1)),packages/neuralsvcd.c) $(LIBRARY) $(ROOMS)
	@mkdir -p $$(@D) && rm -f $$(@:.o=.gcda)
	$$(CC) $$(FLAGS_$(1)) -std=c99 $$(TEST_WARNINGS) -c -o $$@ $$<
build/$(1)/promises_%: tests/promises/%.c build/$(1)/library.o $(PROMISE_HELPERS)
	@rm -f $$@-*.gcda
	$$(CC) $$(FLAGS_$(1)) -pthread -std=c99 $$(TEST_WARNINGS) -DTEST_ALONE -o $$@ $$< build/$(1)/library.o -lm
build/$(1)/test_%: tests/test_%.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY)
	@mkdir -p $$(@D) && rm -f $$@-*.gcda
	$$(CC) $$(FLAGS_$(1)) -pthread -std=c99 $$(TEST_WARNINGS) $$(CCD_CFLAGS) -DTEST_ALONE -o $$@ $$< $$(CCD_LIBS) -lm
build/$(1)/%.txt: build/$(1)/%
	@$$< $$(RUN_$(1)) >$$@.part 2>&1 || { grep -E 'ERROR|WARNING|runtime error|failed' $$@.part; echo "$$<: see $$@.part"; exit 1; }
	@mv $$@.part $$@ && echo "$$<: $$$$(tail -1 $$@)"
endef
$(foreach kind,apart sanitized threads covered 32,$(eval $(call flavour,$(kind))))
.PRECIOUS: $(foreach kind,sanitized threads covered 32,$(ALL_TESTS:%=build/$(kind)/%))
check-tools: $(patsubst %,build/apart/test_%.txt,$(filter-out processor,$(TESTS_APART)))  # the oracle and the planners that tests and benchmarks use
check-processor: build/apart/test_processor.txt  # SSE2, AVX2 and AVX-512 in one program: answers agree
check-exact: build/apart/test_exact  # 50,000 pairs of triangles at the edge against exact arithmetic; TEST_MANY=100: twice as many
	TEST_MANY=$(or $(TEST_MANY),50) build/apart/test_exact
can_link = $(shell echo 'int main(void) { return 0; }' | $(1) -x c - -o /dev/null 2>/dev/null && echo 1)

# The address and the undefined behaviour sanitizer; test_processor.c has what is for AVX2 and AVX-512 too.
SANITIZED = $(PROMISES) test_mesh test_body test_facets test_query
sanitize = @$(if $(call can_link,$(CC) $(SANITIZE_FLAGS)),$(MAKE) $(1:%=build/sanitized/%.txt),\
	  echo "check-sanitizers: $(CC) has no sanitizers: not tested")
check-sanitizers:  # the promises and four files of tests under the address and undefined behaviour sanitizers
	$(call sanitize,$(SANITIZED))
check-sanitizers-all:  # all of them
	$(call sanitize,$(ALL_TESTS))
# The thread sanitizer, where threads share bodies: tests whose names contain this.
RUN_threads = threads
THREADED = $(patsubst tests/%.c,%,$(shell grep -l 'RUN.*$(RUN_threads)' tests/test_*.c tests/promises/*.c))
check-threads:  # threads that share bodies, under the thread sanitizer
	@$(if $(call can_link,$(CC) -fsanitize=thread),$(MAKE) $(patsubst %,build/threads/%.txt,$(subst /,_,$(THREADED))),\
	  echo "check-threads: $(CC) has no thread sanitizer: not tested")
# On other processors, under QEMU: ARCHS="aarch64 s390x" (Debian: qemu-user, gcc-aarch64-linux-gnu, gcc-arm-linux-gnueabihf,
# gcc-riscv64-linux-gnu, gcc-powerpc64le-linux-gnu, gcc-s390x-linux-gnu, and libc6-dev-ARCH-cross of each).
check-cross:  # aarch64, armhf, riscv64, ppc64le, s390x, under QEMU
	CC="$(CC)" tests/cross.sh $(ARCHS)

# Lines and branches of src/ that the tests reach, and those lines that they do not (Debian: gcovr). With -j16 some
# minutes. So many are demanded, per cent.
COVERED_LINES = 97
COVERED_BRANCHES = 95
coverage:  ## what the tests reach of the rooms; make -j16, minutes
	@if command -v gcovr >/dev/null; then \
	  $(MAKE) $(ALL_TESTS:%=build/covered/%.txt) && gcovr --root . --filter src/ \
	    --gcov-ignore-parse-errors --txt --print-summary --fail-under-line $(COVERED_LINES) --fail-under-branch $(COVERED_BRANCHES) build/covered; \
	else echo "coverage: no gcovr: not tested"; fi

# At random, in the whole header: MUTANTS=100 JOBS=16, PART=0 OF=4: every fourth, SEED.
mutate:  ## mistakes in the header at random: how many do the tests notice? MUTANTS=20 SEED=1 JOBS=1 PART=0 OF=1
	python3 tests/mutate.py --cc "$(CC)" --count $(or $(MUTANTS),20) --seed $(SEED) --jobs $(JOBS) \
	  --part $(or $(PART),0) --of $(or $(OF),1)
mutants:  ## the header with one mistake at a time: the tests of the proof must catch each; minutes
	CC="$(CC)" tests/mutants.sh
