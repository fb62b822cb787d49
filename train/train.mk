# Included by the Makefile: the recipe of the shipped weights, as train/README.md has it. CHECKPOINT=file skips the training.
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
