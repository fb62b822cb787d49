# Included by the Makefile: inputs at random.
# Under sanitizers where the compiler has them: tests/fuzz/main.h says how a target is run by itself.
FUZZ_TARGETS = $(filter-out library,$(patsubst tests/fuzz/%.c,%,$(wildcard tests/fuzz/*.c)))
FUZZ_CFLAGS = -O1 -g -std=c99 $(TEST_WARNINGS)
SANITIZE = $(if $(call can_link,$(CC) $(SANITIZE_FLAGS)),$(SANITIZE_FLAGS))
FUZZ_HEADERS = $(wildcard tests/fuzz/*.h) tests/failing_heap.h $(SCENERY)
build/fuzz/library.o: tests/fuzz/library.c $(LIBRARY)
	@mkdir -p $(@D)
	$(CC) $(FUZZ_CFLAGS) $(SANITIZE) -c -o $@ $<
$(FUZZ_TARGETS:%=build/fuzz/%): build/fuzz/%: tests/fuzz/%.c build/fuzz/library.o $(FUZZ_HEADERS) neuralsvcd.h
	$(CC) $(FUZZ_CFLAGS) $(SANITIZE) -o $@ $< build/fuzz/library.o -lm
check-fuzz: $(FUZZ_TARGETS:%=build/fuzz/%)  # their corpora, and files that are made from them, under sanitizers
	@for target in $(FUZZ_TARGETS); do \
	  case $$target in obj|stl|ply|glb|problem) made=20000 ;; *) made=0 ;; esac; \
	  build/fuzz/$$target --random $$made 1 --out build/fuzz/$$target.crash tests/fuzz/corpus/$$target || exit 1; done

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
