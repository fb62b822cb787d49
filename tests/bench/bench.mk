# Included by the Makefile: benchmarks.

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
build/world_peers: tests/bench/world_peers.cc tests/bench/bench_world.c $(HELPERS) $(PEERS) $(SCENERY) $(LIBRARY) | build
	$(CXX) $(CFLAGS) -std=c++11 $(WARNINGS) -Wno-unused-function $(BULLET_CFLAGS) -o $@ $< $(BULLET_LIBS) -lm
# WORLD=casts, rest or frames: one of them. BULLET=folder: as the Makefile says.
bench-world: build/bench_world $(if $(HAVE_BULLET),build/world_peers)  ## casts, rest and frames of a world; Bullet's beside it
	build/bench_world $(WORLD)
	$(if $(HAVE_BULLET),build/world_peers $(WORLD),@echo "bench-world: no libbullet-dev: Bullet is not measured")
bench-asks: build/bench_asks build/game $(ASKED)  ## what first contacts, clearances and skins cost
	@mkdir -p build/motions
	build/game --frames 300 --problems build/motions
	build/bench_asks build/motions/game.txt 0.002
	for file in $(ASKED); do build/bench_asks $$file || exit 1; done
bench-looks: build/bench_looks  ## looks beside proofs of the same places: how long, how often wrong
	build/bench_looks
# Of an arm in seven scenes, proven; and by other checks of its edges, which take longer: ROUTES=100 for the tables.
bench-routes: build/bench_routes build/route_peers  ## an arm's routes, proven; and by other checks of its edges
	build/bench_routes $(or $(ROUTES),10) 0 1
	build/route_peers $(or $(ROUTES),10) 0 1
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

# MEASURE=1 MESHES=folder measures anew, in minutes; without it the table that is there is drawn.
TRADE = tests/bench/trade
trade-picture: $(if $(MEASURE),build/bench $(BENCH_REAL) $(DATA)/hollow.txt $(BENCH_REST))  ## README's picture of the trade, tests/bench/trade.svg
	$(if $(MEASURE),build/bench --trade --limit 600 --out build/trade real=$(subst $(space),$(comma),$(strip $(BENCH_REAL))) \
	  hollow=$(DATA)/hollow.txt rest=$(BENCH_REST))
	python3 $(TRADE).py $(TRADE).tsv $(TRADE).svg $(if $(MEASURE),build/trade.tsv)
.PHONY: trade-picture
