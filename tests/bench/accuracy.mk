# Included by the Makefile: the sets of problems and the accuracy on each.

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
