# neuralsvcd.h is one header: there is nothing to build in order to use it. This builds the examples and the tests.
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
# What the examples and the tests share.
SCENERY = $(wildcard examples/scenery/*.h)

# libccd checks the oracle on convex pairs. Found by pkg-config, or by its header where that is not installed.
HASH := \#
HAVE_CCD := $(shell (pkg-config --exists ccd || echo '$(HASH)include <ccd/ccd.h>' | $(CC) -E -x c - >/dev/null) 2>/dev/null && echo 1)
ifeq ($(HAVE_CCD),1)
CCD_CFLAGS := -DHAVE_LIBCCD $(shell pkg-config --cflags ccd 2>/dev/null)
CCD_LIBS := $(shell pkg-config --libs ccd 2>/dev/null || echo -lccd)
endif

ifeq ($(BENCH),quick)
COUNT ?= 200
endif

.PHONY: firmware check-firmware bench-asks bench-level bench-scale race mutants bench-plan preview profile instructions sizes bench check-extremes all demo test assets problems accuracy weights format clean help check-header check-tiles check-32 check-examples check-problems check-gradient check-motions check-text
.DELETE_ON_ERROR:

PLANNERS = build/dish_insertion build/bimanual_insertion build/mining_site

all: build/svcd build/quickstart build/game build/fly_through $(PLANNERS)  ## the examples: build/svcd, build/quickstart, build/game, build/fly_through and three that plan motions

help:  ## this list
	@sed -n 's/^\([a-z][a-z-]*\):.*##/\1:/p' $(MAKEFILE_LIST) | sort

build:
	mkdir -p build

# ---------------------------------------------------------------------------------------------------------- examples

EXAMPLES = $(patsubst examples/%.c,build/%,$(wildcard examples/*.c))
$(EXAMPLES): build/%: examples/%.c $(wildcard examples/*.h) $(SCENERY) $(LIBRARY) | build
	$(CC) $(ALL_CFLAGS) -o $@ $< -lm
build/game build/fly_through: WARNINGS += -Wno-unused-function  # of problem_file.h

demo: build/quickstart build/game build/fly_through $(PLANNERS)  ## the examples, seconds each: what they find, and a picture each in build/
	build/quickstart
	build/game
	build/fly_through
	build/dish_insertion
	build/bimanual_insertion
	build/mining_site

preview: build/tasks_preview  ## the planning tasks as pictures: build/task_*.svg
	build/tasks_preview

assets: build/make_assets  ## writes examples/assets/*.obj, which are in the repository, anew
	build/make_assets examples/assets

# ------------------------------------------------------------------------------------------------------------- tests

HELPERS = $(wildcard tests/*.h tests/data/*.h)
PEERS = $(wildcard tests/bench/*.h)
TEST_OBJECTS = build/main.o $(patsubst tests/%.c,build/%.o,$(wildcard tests/test_*.c))
# Each test file holds its own copy of the header, and uses only a part of its private functions.
TEST_WARNINGS = -Wall -Wextra -Werror -Wno-unused-function

$(TEST_OBJECTS): build/%.o: tests/%.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS) -pthread -std=c99 $(TEST_WARNINGS) $(CCD_CFLAGS) -c -o $@ $<
build/tests: $(TEST_OBJECTS)
	$(CC) $(CFLAGS) -pthread -o $@ $(TEST_OBJECTS) $(CCD_LIBS) -lm

# Peers, generators and benchmarks.
BENCHES = $(patsubst tests/bench/%.c,build/%,$(wildcard tests/bench/*.c))
$(BENCHES): build/%: tests/bench/%.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(ALL_CFLAGS) -Wno-unused-function $(CCD_CFLAGS) -o $@ $< $(CCD_LIBS) -lm

check-header: | build  # as C99 to C++17, strictly, and what it leaves in the namespace
	CC="$(CC)" CXX="$(CXX)" tests/header.sh
check-examples: all build/make_assets  # they run, and they say no as FORMATS.md demands
	tests/examples.sh
check-problems: build/problems build/svcd  # every set that the generator can make
	tests/bench/problems.sh

# The gradient, with each of these switches.
GRADIENT_SWITCHES = SIMD FLOAT INT8 BASE SMALL,BASE
build/gradient_%: tests/test_gradient.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS) -std=c99 $(TEST_WARNINGS) -DTEST_ALONE $(patsubst %,-DNSVCD_NO_%,$(subst $(comma), ,$*)) -o $@ $< -lm
check-gradient: $(GRADIENT_SWITCHES:%=build/gradient_%)
	@for test in $^; do echo $$test; $$test >$$test.txt || { cat $$test.txt; exit 1; }; tail -1 $$test.txt; done

# The tests of the proof, alone; PROOF_MANY=10 in the environment: 10^6 crossings.
build/test_proof: tests/test_proof.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS) -std=c99 $(TEST_WARNINGS) -DTEST_ALONE -o $@ $< -lm
# The same, with tiles of two groups: bodies of more than 32 patches are searched tile by tile.
build/test_tiles: tests/test_proof.c $(HELPERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS) -std=c99 $(TEST_WARNINGS) -DNSVCD__TILE=2 -DTEST_ALONE -o $@ $< -lm
check-tiles: build/test_tiles
	@build/test_tiles >build/test_tiles.txt || { cat build/test_tiles.txt; exit 1; }; echo build/test_tiles; tail -1 build/test_tiles.txt
# On 32 bits, where sizes end at 4 GB, under sanitizers; where the compiler can (Debian: gcc-multilib).
CFLAGS_32 = -m32 -msse2 -mfpmath=sse -O1 -fsanitize=address,undefined -fno-sanitize-recover=all
build/test_%_32: tests/test_%.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY) | build
	$(CC) $(CFLAGS_32) -pthread -std=c99 $(TEST_WARNINGS) -DTEST_ALONE -o $@ $< -lm
check-32:
	@if echo 'int main(void) { return 0; }' | $(CC) $(CFLAGS_32) -x c -o build/can_32 - 2>/dev/null; then \
	  $(MAKE) build/test_level_32 build/test_optimizer_32 && build/test_level_32 && build/test_optimizer_32 plan_sizes; \
	else echo "check-32: $(CC) has no libraries for -m32: not tested"; fi
# On Cortex-M4F and M7 under QEMU, where its tools are there (Debian: gcc-arm-none-eabi, libnewlib-arm-none-eabi, qemu-system-arm).
check-firmware: | build
	$(MAKE) -C examples/firmware LEVELS=O2 run
firmware: | build  ## Cortex-M under QEMU: answers as on the host; flash, RAM, stack and instructions as a table
	$(MAKE) -C examples/firmware run table
mutants:  ## the header with one mistake at a time: the tests of the proof must catch each; minutes
	CC="$(CC)" tests/mutants.sh

# What moving things ask, against conservative advancement in double: pairs of the game, and with MOTIONS="FILE ..." problem
# files; FIRST: tolerance of first contacts, a share of the motion. FRAMES=1000 for more.
FRAMES = 60
FIRST = 0.01
check-motions: build/check_motions build/game build/problems build/svcd  ## first contacts, clearances and two movers against an oracle
	@mkdir -p build/motions
	build/problems --set standard --meshes procedural --count 100 --seed 407 --out build/motions/standard.txt
	build/check_motions build/motions/standard.txt 0 $(FIRST)
	@! command -v python3 >/dev/null || { python3 tests/bench/carry.py build/motions/standard.txt build/motions/carried.txt && \
	  build/check_motions build/motions/carried.txt 0 $(FIRST) && \
	  build/svcd check --repeat 1 build/motions/carried.txt 2>&1 >/dev/null | grep '^accuracy *100.00'; }
	build/game --frames $(FRAMES) --problems build/motions
	build/check_motions build/motions/game.txt 0.002 $(FIRST)
	@for file in $(MOTIONS); do echo $$file; build/check_motions $$file 0 $(FIRST) || exit 1; done

check-extremes: build/problems build/svcd  # tiny, huge, far, thin, spinning ...
	tests/bench/extremes.sh

test: build/tests check-text check-header check-gradient check-examples check-tiles check-32 check-firmware check-motions check-problems check-extremes  ## everything; the last line is `N passed, N failed`
	build/tests

# ---------------------------------------------------------------------------------------------------------- accuracy

problems: build/problems  ## the generator of exactly labelled problems

# The seeds and counts of the measured accuracy; COUNT=200 for a quick look. Labelling takes minutes.
DATA = build/accuracy$(if $(COUNT),_$(COUNT))
MESHES = ../shared/meshes
REAL = $(patsubst $(MESHES)/%.tar.gz,%,$(wildcard $(MESHES)/random_urdfs.tar.gz $(MESHES)/metaworld.tar.gz))
COUNT_standard = $(or $(COUNT),4000)
COUNT_hollow = $(or $(COUNT),1000)
COUNT_inside = $(or $(COUNT),400)
COUNT_random_urdfs = $(or $(COUNT),2000)
COUNT_metaworld = $(or $(COUNT),2000)
COUNT_open = $(or $(COUNT),500)
COUNT_large = $(or $(COUNT),1000)
# What bodies do, and meshes that are hard to get right.
COUNT_rest = $(or $(COUNT),2000)
COUNT_rest_real = $(or $(COUNT),2000)
COUNT_nested = $(or $(COUNT),1000)
COUNT_same = $(or $(COUNT),1000)
COUNT_one = $(or $(COUNT),1000)
COUNT_soup = $(or $(COUNT),500)
COUNT_slivers = $(or $(COUNT),300)
HARD = rest nested same one soup slivers
SETS = standard hollow inside $(REAL) $(if $(filter metaworld,$(REAL)),open) $(HARD) $(if $(filter random_urdfs,$(REAL)),rest_real) $(if $(REAL),large)
CHECK_FLAGS =

$(DATA)/standard.txt: | build/problems
	@mkdir -p $(DATA)
	build/problems --set standard --meshes procedural --count $(COUNT_standard) --seed 401 --out $@
$(DATA)/hollow.txt: | build/problems
	@mkdir -p $(DATA)
	build/problems --set hollow --meshes procedural --count $(COUNT_hollow) --seed 404 --out $@
$(DATA)/inside.txt: | build/problems
	@mkdir -p $(DATA)
	build/problems --set inside --meshes procedural --count $(COUNT_inside) --seed 405 --out $@
$(DATA)/random_urdfs.txt: $(DATA)/meshes/random_urdfs | build/problems
	build/problems --set standard --meshes $(DATA)/meshes/random_urdfs --count $(COUNT_random_urdfs) --seed 402 --out $@
$(DATA)/metaworld.txt: $(DATA)/meshes/metaworld | build/problems
	build/problems --set standard --meshes $(DATA)/meshes/metaworld --count $(COUNT_metaworld) --seed 403 --out $@
$(DATA)/open.txt: $(DATA)/meshes/metaworld | build/problems  # meshes that are not closed
	build/problems --set standard --meshes $(DATA)/meshes/metaworld --open only --count $(COUNT_open) --seed 406 --out $@
$(HARD:%=$(DATA)/%.txt): $(DATA)/%.txt: | build/problems
	@mkdir -p $(DATA)
	build/problems --set $* --meshes procedural --count $(COUNT_$*) --seed 407 --out $@
$(DATA)/rest_real.txt: $(DATA)/meshes/random_urdfs | build/problems
	build/problems --set rest --meshes $(DATA)/meshes/random_urdfs --count $(COUNT_rest_real) --seed 408 --out $@
$(DATA)/large.txt: $(DATA)/meshes/large | build/problems  # closed meshes of 1,500 triangles and more
	build/problems --set standard --meshes $(DATA)/meshes/large --count $(COUNT_large) --seed 409 --out $@
$(DATA)/meshes/large: $(REAL:%=$(DATA)/meshes/%)
	mkdir -p $@.part
	for mesh in $(REAL:%=$(DATA)/meshes/%/*.obj); do [ `grep -c '^f' $$mesh` -lt 1500 ] || cp $$mesh $@.part/; done
	mv $@.part $@
# All OBJ files of the archive, flat.
$(DATA)/meshes/%: | $(MESHES)/%.tar.gz
	mkdir -p $@.part
	tar xzf $(MESHES)/$*.tar.gz -C $@.part
	find $@.part -mindepth 2 -name '*.obj' -exec mv -n {} $@.part/ \;
	mv $@.part $@
.PRECIOUS: $(DATA)/%.txt $(DATA)/meshes/%

accuracy: build/svcd $(SETS:%=$(DATA)/%.txt)  ## labels the problem sets (minutes, kept) and measures on each
	@for set in $(SETS); do echo; build/svcd check $(CHECK_FLAGS) $(DATA)/$$set.txt >$(DATA)/$$set.tsv || exit 1; done

# --------------------------------------------------------------------------------------------------------- benchmark

# Sets at the extremes: 300 problems each, answered by NeuralSVCD alone.
EXTREMES = thin spin still tiny huge inside cavity far mixed offset
build/extremes/%.txt: | build/problems
	@mkdir -p build/extremes
	build/problems --set $* --meshes procedural --count 300 --seed 501 --out $@
.PRECIOUS: build/extremes/%.txt

# BENCH=quick: fewer settings on 200 problems a set, two minutes. PROBLEMS=file: your own problems instead.
ifdef PROBLEMS
BENCH_SETS = $(basename $(notdir $(PROBLEMS)))=$(PROBLEMS)
else
BENCH_SETS = $(if $(REAL),real=$(subst $(space),$(comma),$(REAL:%=$(DATA)/%.txt)),standard=$(DATA)/standard.txt) \
  hollow=$(DATA)/hollow.txt rest=$(DATA)/$(if $(filter random_urdfs,$(REAL)),rest_real,rest).txt \
  $(if $(BENCH),,$(foreach set,$(EXTREMES),$(set)=build/extremes/$(set).txt))
BENCH_FILES = $(if $(REAL),$(REAL:%=$(DATA)/%.txt),$(DATA)/standard.txt) $(DATA)/hollow.txt \
  $(DATA)/$(if $(filter random_urdfs,$(REAL)),rest_real,rest).txt $(if $(BENCH),,$(EXTREMES:%=build/extremes/%.txt))
endif
comma := ,
space := $(subst x,,x x)

bench-scale: build/bench_scale  ## bytes and microseconds against triangles, 12 to a million, and against N: table, build/scale.svg
	build/bench_scale
bench-level: build/bench_level  ## a level of 20 m as one body: encoding, memory, and motions of a frame
	for n in 20000 60000 200000 1000000; do build/bench_level $$n $(or $(LEVEL_MOTIONS),200) || exit 1; done
bench-asks: build/bench_asks build/game $(DATA)/standard.txt $(DATA)/hollow.txt $(DATA)/rest.txt  ## what first contacts, clearances and skins cost
	@mkdir -p build/motions
	build/game --frames 300 --problems build/motions
	build/bench_asks build/motions/game.txt 0.002
	build/bench_asks $(DATA)/standard.txt
	build/bench_asks $(DATA)/hollow.txt
	build/bench_asks $(DATA)/rest.txt

profile: build/profile $(DATA)/random_urdfs.txt $(DATA)/hollow.txt $(DATA)/rest.txt  ## where a query's time goes, stage by stage
	build/profile $(DATA)/random_urdfs.txt 64 128 512
	build/profile $(DATA)/hollow.txt 512
	build/profile $(DATA)/rest.txt 256

instructions: $(DATA)/random_urdfs.txt  ## what a query executes, counted by callgrind
	CC="$(CC)" tests/bench/instructions.sh $(DATA)/random_urdfs.txt 64 512

sizes:  ## code and data that each compile-time switch leaves out, host and Cortex-M
	CC="$(CC)" tests/bench/sizes.sh

bench: build/bench $(BENCH_FILES)  ## every method on the same problems: table, build/tradeoff.tsv, build/tradeoff.svg
	build/bench $(if $(BENCH),--quick --limit 150,--limit 600) $(BENCH_SETS)

# The proof, the network's default and the mesh hierarchy on all sets, in one run: for ratios.
race: build/bench $(BENCH_FILES) $(DATA)/standard.txt $(HARD:%=$(DATA)/%.txt) $(if $(REAL),$(DATA)/large.txt)  ## the proof against the hierarchy and the network, minutes
	build/bench --race --out build/race $(if $(LIMIT),--limit $(LIMIT)) $(BENCH_SETS) standard=$(DATA)/standard.txt $(foreach set,$(filter-out rest,$(HARD)) $(if $(REAL),large),$(set)=$(DATA)/$(set).txt)

# EPISODES=10 for a quick look; 100, the default, take half an hour.
bench-plan: build/plan_bench  ## four planners on three tasks: table, build/plan.tsv, build/plan.svg
	build/plan_bench --episodes $(or $(EPISODES),100) --tsv build/plan.tsv
	build/plan_bench chart build/plan.tsv build/plan.svg

# ---------------------------------------------------------------------------------------------------------- training

# The recipe of the shipped weights: train/README.md. CHECKPOINT=file skips the training.
CHECKPOINT = build/train/checkpoint.pt
PYTHON ?= python3
CALIBRATION = build/calibration

build/train/checkpoint.pt:
	cd train && $(PYTHON) train.py --out ../build/train --groups 5000 --shapes 6000 --seed 11 --rate 6e-3 --steps 51341 \
	  --shape '{"channels":4,"heads":[["tiny",[32,16]],["small",[96,32]],["base",[160,128,32]]]}'
$(CALIBRATION)/standard.txt: | build/problems
	@mkdir -p $(CALIBRATION)
	build/problems --set standard --meshes procedural --count 8000 --pool 400 --seed 301 --out $@
$(CALIBRATION)/hollow.txt: | build/problems
	@mkdir -p $(CALIBRATION)
	build/problems --set hollow --meshes procedural --count 4000 --seed 302 --out $@
.PRECIOUS: $(CALIBRATION)/%.txt

weights: $(CHECKPOINT) $(CALIBRATION)/standard.txt $(CALIBRATION)/hollow.txt  ## trains anew on a GPU, calibrates, writes weights.h
	cd train && $(PYTHON) export.py ../$(CHECKPOINT) ../weights.h ../tests/data/golden.h uncalibrated
	$(MAKE) build/svcd
	cd train && $(PYTHON) calibrate.py ../$(CHECKPOINT) ../build/svcd $(CALIBRATION:%=../%/standard.txt) $(CALIBRATION:%=../%/hollow.txt)
	cd train && $(PYTHON) export.py ../$(CHECKPOINT) ../weights.h ../tests/data/golden.h

FORMATTED = neuralsvcd.h $(wildcard examples/*.[ch] examples/scenery/*.h examples/firmware/*.[ch] tests/*.[ch] tests/bench/*.[ch])
format:  ## clang-format on what is written by hand
	clang-format -i $(FORMATTED)
# Version 14 decides, as in Debian 12: others break lines elsewhere.
check-text:  ## the header as a text: its lines, functions, contents, the order of its sections; and that all is formatted
	@if command -v python3 >/dev/null; then python3 tests/text.py; else echo "check-text: no python3: not tested"; fi
	@if clang-format --version 2>/dev/null | grep -q 'version 14'; then clang-format --dry-run -Werror $(FORMATTED); \
	else echo "check-text: no clang-format 14: format not tested"; fi

clean:  ## removes build/
	rm -rf build
