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
EXTRAS = extras/neuralsvcd_certify.h extras/neuralsvcd_robot.h extras/neuralsvcd_world.h
LIBRARY = neuralsvcd.h weights.h $(EXTRAS)
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

# Bullet answers what bench_world asks: Debian's libbullet-dev; or BULLET=folder, its source, compiled as we are.
ifdef BULLET
HAVE_BULLET := 1
BULLET_CFLAGS = -isystem $(BULLET)/src -w
BULLET_LIBS = $(wildcard $(BULLET)/src/bt*All.cpp)
else
HAVE_BULLET := $(shell pkg-config --exists bullet 2>/dev/null && echo 1)
BULLET_CFLAGS = $(patsubst -I%,-isystem %,$(shell pkg-config --cflags bullet))
BULLET_LIBS = $(shell pkg-config --libs bullet)
endif

ifeq ($(BENCH),quick)
COUNT ?= 200
endif

.PHONY: all demo preview assets header api help format clean firmware web weights problems accuracy
.PHONY: shared static release install uninstall npm crate check-packages
.PHONY: test check check-release
.PHONY: bench-one-path python mutants fuzz coverage mutate
.PHONY: bench bench-certificates bench-asks bench-casts bench-distance bench-flags bench-level bench-looks bench-routes bench-scale bench-world bench-plan race profile instructions sizes
.DELETE_ON_ERROR:

PLANNERS = build/dish_insertion build/bimanual_insertion build/mining_site
DEMOS = build/quickstart build/plan build/game build/fly_through $(PLANNERS)

all: build/svcd build/verify $(DEMOS)  ## the examples, in build/: svcd, verify, quickstart, plan, game, fly_through and three tasks for arms

help:  ## this list
	@sed -n 's/^\([a-z][a-z-]*\):.*##/\1:/p' $(MAKEFILE_LIST) | sort

build:
	mkdir -p build

header:  ## writes neuralsvcd.h and extras/ from the rooms of src/; LINES=1: errors and debuggers name these
	python3 src/make_header.py $(if $(LINES),--lines)
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

clean:  ## removes build/
	rm -rf build

# What else there is, each a page: packages, tests, checks, inputs at random, accuracy, benchmarks, training.
include packages/packages.mk tests/tests.mk tests/fuzz/fuzz.mk tests/checks.mk formal/formal.mk
include tests/bench/accuracy.mk tests/bench/bench.mk train/train.mk
