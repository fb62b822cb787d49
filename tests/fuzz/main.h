// main.h - what the fuzz targets share: how bytes become numbers, a mutator, and a main for where
// there is no libFuzzer. A target is a file that defines FUZZ_TARGET, its name, and FUZZ_TOKENS,
// texts that its inputs are made of, each with a comma behind it, includes this before all else, and
// defines LLVMFuzzerTestOneInput.
//
//   TARGET FILE|FOLDER...                  runs these inputs
//   TARGET --random N SEED FILE|FOLDER...  then N that are made from them: the same for one SEED
//   TARGET --seconds S                     ends after so many seconds
//   TARGET --out FILE                      where an input that fails is kept: TARGET.crash
//
// With FUZZ_LIBFUZZER defined, libFuzzer has the main, and half of its inputs come from this
// mutator.
#ifndef NSVCD_TESTS_FUZZ_MAIN_H
#define NSVCD_TESTS_FUZZ_MAIN_H

#ifndef _POSIX_C_SOURCE
#define _POSIX_C_SOURCE 200112L  // alarm, opendir
#endif
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FUZZ_MOST 8192  // bytes of an input
static const char *const fuzz_tokens[] = {FUZZ_TOKENS NULL};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Inputs that the library took, as the target counts them.
static unsigned long long fuzz_taken;

#define FUZZ_CHECK(condition)                                                            \
  do {                                                                                   \
    if (!(condition)) {                                                                  \
      fprintf(stderr, "%s:%d: FUZZ_CHECK(%s) failed\n", __FILE__, __LINE__, #condition); \
      abort();                                                                           \
    }                                                                                    \
  } while (0)

// ---------------------------------------------------------------------------------- random numbers

static uint64_t fuzz_state;

static uint64_t fuzz_next(void) {  // splitmix64 (Vigna)
  uint64_t z = (fuzz_state += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

static size_t fuzz_below(size_t n) {
  return n > 0 ? (size_t)(fuzz_next() % n) : 0;
}

// --------------------------------------------------------------------------------- bytes as numbers

// The input, from front to back. Past its end there are zeros.
typedef struct fuzz_input {
  const uint8_t *at;
  size_t left;
} fuzz_input;

static uint8_t fuzz_byte(fuzz_input *in) {
  if (in->left == 0)
    return 0;
  in->left--;
  return *in->at++;
}

static uint32_t fuzz_u32(fuzz_input *in) {
  uint32_t value = 0;
  for (int k = 0; k < 4; k++)
    value |= (uint32_t)fuzz_byte(in) << (8 * k);
  return value;
}

static size_t fuzz_choice(fuzz_input *in, size_t n) {
  return fuzz_byte(in) % n;
}

static float fuzz_of_bits(uint32_t bits) {
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

// What arithmetic stumbles over: NaN, infinity, denormals, and the limits of the library.
static const uint32_t fuzz_numbers[] = {
    0x00000000u, 0x80000000u, 0x3f800000u, 0xbf800000u,  // 0, -0, 1, -1
    0x7fc00000u, 0xffc00001u, 0x7f800000u, 0xff800000u,  // NaN, infinity
    0x00000001u, 0x80000001u, 0x007fffffu, 0x00800000u,  // denormals, FLT_MIN
    0x7f7fffffu, 0xff7fffffu, 0x7effffffu, 0x5a0e1bcau,  // FLT_MAX, its half, 1e16
    0x49742400u, 0x49742408u, 0xc9742400u, 0x358637bdu,  // 1e6, beyond it, -1e6, 1e-6
    0x2b8cbcccu, 0x2b8cbccdu, 0x33d6bf95u, 0x3f7fffffu,  // 1e-12, 1e-7, below 1
};
enum { FUZZ_NUMBERS = sizeof fuzz_numbers / sizeof *fuzz_numbers };

// Mostly a number as scenes have them, within +-2; else one of those above, or any.
static float fuzz_float(fuzz_input *in) {
  const uint8_t kind = fuzz_byte(in);
  if (kind < 252)
    return ((float)kind * 256 + fuzz_byte(in) - 32256) / 16128;
  if (kind < 254)
    return fuzz_of_bits(fuzz_numbers[fuzz_choice(in, FUZZ_NUMBERS)]);
  return fuzz_of_bits(fuzz_u32(in));
}

// In [0,1], mostly a small one: for tolerances.
static float fuzz_length(fuzz_input *in) {
  const uint8_t kind = fuzz_byte(in);
  if (kind < 128)
    return 0;
  return kind < 252 ? ldexpf(1, (128 - (int)kind) / 8) : fuzz_float(in);
}

// -------------------------------------------------------------------------------------- the mutator

static size_t fuzz_insert(uint8_t *data, size_t size, size_t most, size_t at, const void *what,
                          size_t length) {
  if (length == 0 || length > most - size)
    return size;
  memmove(data + at + length, data + at, size - at);
  memcpy(data + at, what, length);
  return size + length;
}

// One change. other: another input, of which a part may be taken.
static size_t fuzz_change(uint8_t *data, size_t size, size_t most, const uint8_t *other,
                          size_t other_size) {
  uint8_t part[64];
  const size_t at = fuzz_below(size);
  size_t length = 1 + fuzz_below(fuzz_below(4) ? 4 : 64);
  switch (fuzz_below(6)) {
    case 0:
      for (size_t k = at; k < size && k < at + length; k++)
        data[k] = (uint8_t)fuzz_next();
      return size;
    case 1:
      if (size > 0)
        data[at] ^= (uint8_t)(1 << fuzz_below(8));
      return size;
    case 2:  // cut out
      if (length > size - at)
        length = size - at;
      memmove(data + at, data + at + length, size - at - length);
      return size - length;
    case 3:  // double
      if (length > size - at)
        length = size - at;
      memcpy(part, data + at, length);
      return fuzz_insert(data, size, most, fuzz_below(size + 1), part, length);
    case 4: {
      const uint32_t word = fuzz_numbers[fuzz_below(FUZZ_NUMBERS)];
      if (size - at >= 4)
        memcpy(data + at, &word, 4);
      return size;
    }
    default: {
      const size_t from = fuzz_below(other_size);
      if (length > other_size - from)
        length = other_size - from;
      return fuzz_insert(data, size, most, fuzz_below(size + 1), other + from, length);
    }
  }
}

// A place in a text where a token begins, or its end.
static size_t fuzz_boundary(const uint8_t *data, size_t size) {
  size_t at = fuzz_below(size + 1);
  while (at > 0 && at < size && !strchr(" \n", data[at - 1]))
    at++;
  return at;
}

// One change of a text: tokens come and go, and whole lines do.
static size_t fuzz_change_text(uint8_t *data, size_t size, size_t most) {
  uint8_t line[256];
  const size_t at = fuzz_boundary(data, size);
  const char *token = fuzz_tokens[fuzz_below(sizeof fuzz_tokens / sizeof *fuzz_tokens - 1)];
  const size_t kind = fuzz_below(4);
  size_t length = 0;
  if (kind < 2)
    return fuzz_insert(data, size, most, at, token, strlen(token));
  while (at + length < size && length < sizeof line && data[at + length] != '\n')
    length++;
  length += at + length < size && length < sizeof line;
  if (kind == 2) {
    memmove(data + at, data + at + length, size - at - length);
    return size - length;
  }
  memcpy(line, data + at, length);
  return fuzz_insert(data, size, most, fuzz_boundary(data, size), line, length);
}

static size_t fuzz_mutate(uint8_t *data, size_t size, size_t most, const uint8_t *other,
                          size_t other_size) {
  const int is_text = sizeof fuzz_tokens > sizeof *fuzz_tokens && fuzz_below(4);
  for (size_t n = 1 + fuzz_below(4); n > 0; n--) {
    if (is_text)
      size = fuzz_change_text(data, size, most);
    else
      size = fuzz_change(data, size, most, other, other_size);
  }
  return size;
}

#ifdef FUZZ_LIBFUZZER
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned int seed);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned int seed) {
  fuzz_state = seed;
  if (seed % 2)
    return LLVMFuzzerMutate(data, size, most);
  return fuzz_mutate(data, size, most, data, 0);
}
#else

// --------------------------------------------------------------------------------------------- main

#include <dirent.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

typedef struct fuzz_file {
  uint8_t *data;
  size_t size;
} fuzz_file;

static fuzz_file *fuzz_corpus;
static size_t fuzz_files;
static uint8_t fuzz_now[FUZZ_MOST];  // the input that is running
static size_t fuzz_now_size;
static const char *fuzz_out = FUZZ_TARGET ".crash";

// Keeps the input that is running. All of it is bytes that are there: it may be called by a signal.
static void fuzz_keep(void) {
  static int kept;
  FILE *file = kept ? NULL : fopen(fuzz_out, "wb");
  kept = 1;
  if (!file)
    return;
  fwrite(fuzz_now, 1, fuzz_now_size, file);
  fclose(file);
  fprintf(stderr, "%s: the input is in %s\n", FUZZ_TARGET, fuzz_out);
}

static void fuzz_dies(int number) {
  fprintf(stderr, "%s: signal %d%s\n", FUZZ_TARGET, number, number == SIGALRM ? ": no end" : "");
  fuzz_keep();
  _exit(1);
}

#if defined(__SANITIZE_ADDRESS__)
#define FUZZ_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FUZZ_SANITIZED
#endif
#endif
#ifdef FUZZ_SANITIZED
void __sanitizer_set_death_callback(void (*callback)(void));
#endif

static void fuzz_watch(void) {
  signal(SIGABRT, fuzz_dies);
  signal(SIGALRM, fuzz_dies);
#ifdef FUZZ_SANITIZED
  __sanitizer_set_death_callback(fuzz_keep);
#else
  signal(SIGSEGV, fuzz_dies);
  signal(SIGFPE, fuzz_dies);
#endif
}

// An input may take so long.
enum { FUZZ_SECONDS = 60 };

static void fuzz_run(void) {
  uint8_t *exact = (uint8_t *)malloc(fuzz_now_size ? fuzz_now_size : 1);  // no byte beside it
  if (!exact)
    exit(2);
  memcpy(exact, fuzz_now, fuzz_now_size);
  alarm(FUZZ_SECONDS);
  (void)LLVMFuzzerTestOneInput(exact, fuzz_now_size);
  alarm(0);
  free(exact);
}

static void fuzz_take_file(const char *path) {
  FILE *file = fopen(path, "rb");
  uint8_t *data = (uint8_t *)malloc(FUZZ_MOST);
  fuzz_file *larger = (fuzz_file *)realloc(fuzz_corpus, (fuzz_files + 1) * sizeof *larger);
  if (!file || !data || !larger) {
    fprintf(stderr, "%s: cannot be read\n", path);
    exit(2);
  }
  fuzz_corpus = larger;
  larger[fuzz_files].data = data;
  larger[fuzz_files++].size = fread(data, 1, FUZZ_MOST, file);
  fclose(file);
}

static int fuzz_by_name(const void *a, const void *b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

// A file, or all files of a folder, by their names: so a seed means the same everywhere.
static void fuzz_take(const char *path) {
  DIR *folder = opendir(path);
  char **names = NULL;
  size_t count = 0;
  if (!folder) {
    fuzz_take_file(path);
    return;
  }
  for (struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
    if (entry->d_name[0] == '.')
      continue;
    char *name = (char *)malloc(strlen(path) + strlen(entry->d_name) + 2);
    names = (char **)realloc(names, (count + 1) * sizeof *names);
    if (!name || !names)
      exit(2);
    sprintf(name, "%s/%s", path, entry->d_name);
    names[count++] = name;
  }
  closedir(folder);
  if (count > 0)
    qsort(names, count, sizeof *names, fuzz_by_name);
  for (size_t k = 0; k < count; k++) {
    fuzz_take_file(names[k]);
    free(names[k]);
  }
  free(names);
}

static void fuzz_run_mutant(uint64_t seed, uint64_t number) {
  static const fuzz_file nothing = {NULL, 0};
  fuzz_state = seed * 1000003 + number;
  const fuzz_file *first = fuzz_files ? &fuzz_corpus[fuzz_below(fuzz_files)] : &nothing;
  const fuzz_file *second = fuzz_files ? &fuzz_corpus[fuzz_below(fuzz_files)] : &nothing;
  if (first->size > 0)
    memcpy(fuzz_now, first->data, first->size);
  fuzz_now_size = fuzz_mutate(fuzz_now, first->size, FUZZ_MOST, second->data, second->size);
  fuzz_run();
}

int main(int argc, char **argv) {
  unsigned long long random = 0;
  unsigned long long seed = 0;
  double seconds = HUGE_VAL;
  const time_t begin = time(NULL);
  fuzz_watch();
  for (int k = 1; k < argc; k++) {
    if (strcmp(argv[k], "--random") == 0 && k + 2 < argc) {
      random = strtoull(argv[k + 1], NULL, 10);
      seed = strtoull(argv[k + 2], NULL, 10);
      k += 2;
    } else if (strcmp(argv[k], "--seconds") == 0 && k + 1 < argc) {
      seconds = atof(argv[++k]);
    } else if (strcmp(argv[k], "--out") == 0 && k + 1 < argc) {
      fuzz_out = argv[++k];
    } else {
      fuzz_take(argv[k]);
    }
  }
  for (size_t k = 0; k < fuzz_files; k++) {
    fuzz_now_size = fuzz_corpus[k].size;
    if (fuzz_now_size > 0)
      memcpy(fuzz_now, fuzz_corpus[k].data, fuzz_now_size);
    fuzz_run();
  }
  unsigned long long done = 0;
  for (; done < random && difftime(time(NULL), begin) < seconds; done++)
    fuzz_run_mutant(seed, done);
  for (size_t k = 0; k < fuzz_files; k++)
    free(fuzz_corpus[k].data);
  free(fuzz_corpus);
  printf("%s: %zu files, %llu made from them with seed %llu, %llu taken: all well\n", FUZZ_TARGET,
         fuzz_files, done, seed, fuzz_taken);
  return 0;
}
#endif  // FUZZ_LIBFUZZER
#endif  // NSVCD_TESTS_FUZZ_MAIN_H
