// Bodies that somebody has changed, their checksums put right: refused, or else harmless, whatever
// is done with them. An input is a body, and changes to it; so it suits every version of the format.
#define FUZZ_TARGET "blob"
#define FUZZ_TOKENS
#include "main.h"

#include "scene.h"

// Where the header of a blob has its checksum, its size, and the way to the body within: section
// *body* of neuralsvcd.h.
enum { AT_CHECKSUM = 8, AT_SIZE = 16, AT_INNER = 60, HEADER = 64 };

typedef struct blob {
  uint8_t *bytes;
  size_t size;
} blob;

static uint32_t word_at(const blob *b, size_t at) {
  uint32_t word;
  memcpy(&word, b->bytes + at, 4);
  return word;
}

// FNV-1a over words, of the part of the blob that begins at `from`; nothing where it claims to be
// larger than what is there.
static void repair(blob *b, size_t from) {
  uint64_t hash = 14695981039346656037u;
  if (from > b->size || b->size - from < HEADER)
    return;
  const size_t size = word_at(b, from + AT_SIZE);
  if (size > b->size - from)
    return;
  for (size_t at = AT_SIZE; at + 4 <= size; at += 4)
    hash = (hash ^ word_at(b, from + at)) * 1099511628211u;
  memcpy(b->bytes + from + AT_CHECKSUM, &hash, sizeof hash);
}

// A number that an array may hold in place of another.
static uint32_t changed_word(fuzz_input *in, uint32_t word) {
  switch (fuzz_choice(in, 6)) {
    case 0:
      return word + 1;
    case 1:
      return word - 1;
    case 2:
      return word ^ (1u << fuzz_choice(in, 32));
    case 3:
      return fuzz_numbers[fuzz_choice(in, FUZZ_NUMBERS)];
    case 4:
      return fuzz_u32(in);
    default: {
      float value = fuzz_of_bits(word);
      value *= 1 + fuzz_float(in);
      memcpy(&word, &value, sizeof word);
      return word;
    }
  }
}

static void change(fuzz_input *in, blob *b) {
  const uint8_t kind = fuzz_byte(in);
  size_t at = fuzz_u32(in) % b->size;
  if (kind % 4 == 0)  // the headers, and what follows them
    at = (kind < 128 ? 0 : word_at(b, AT_INNER)) + at % 128;
  if (at >= b->size)
    return;
  if (kind % 4 == 1) {
    b->bytes[at] = fuzz_byte(in);
    return;
  }
  at -= at % 4;
  if (kind % 32 == 2) {  // a stretch from elsewhere
    const size_t from = fuzz_u32(in) % b->size / 4 * 4;
    const size_t length = 4 * fuzz_choice(in, 64);
    if (length <= b->size - at && length <= b->size - from)
      memmove(b->bytes + at, b->bytes + from, length);
    return;
  }
  const uint32_t word = changed_word(in, word_at(b, at));
  memcpy(b->bytes + at, &word, 4);
}

// What a program does with a body that was loaded.
static void use(fuzz_input *in, const nsvcd_body *body) {
  static const float scales[6] = {1, 0.5f, 1e-3f, 1e3f, 1e6f, 1e-6f};
  const nsvcd_body_facts facts = nsvcd_body_describe(body);
  const nsvcd_body *other = scene_body(fuzz_choice(in, SCENE_BODIES));
  const nsvcd_body *scaled = NULL;
  scene_question asked;
  nsvcd_answer answer;
  float centre[3];
  float radius;
  for (uint32_t k = 0; k < facts.patches; k++)
    FUZZ_CHECK(nsvcd_body_patch(body, k, centre, &radius));
  FUZZ_CHECK(!nsvcd_body_patch(body, (uint32_t)facts.patches, centre, &radius));
  scene_ask_about(in, body, other, &asked);
  scene_ask(&asked.question, &answer);
  scene_ask_about(in, body, body, &asked);
  scene_ask(&asked.question, &answer);

  void *memory = malloc(facts.size);
  if (!memory)
    exit(2);
  // as a whole, or along each axis by another factor, mirrored too
  float by[3];
  by[0] = by[1] = by[2] = scales[fuzz_choice(in, 6)];
  if (fuzz_choice(in, 2)) {
    by[1] = scales[fuzz_choice(in, 6)];
    by[2] = -scales[fuzz_choice(in, 6)];
  }
  if (!nsvcd_body_scale(body, by, memory, facts.size, &scaled)) {
    scene_ask_about(in, other, scaled, &asked);
    scene_ask(&asked.question, &answer);
  }
  free(memory);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  fuzz_input in = {data, size};
  const nsvcd_body *whole = scene_body(fuzz_choice(&in, SCENE_BODIES));
  const nsvcd_body *body = NULL;
  const size_t changes = 1 + fuzz_choice(&in, 5);
  const uint8_t cut = fuzz_byte(&in);
  blob b = {NULL, nsvcd_body_describe(whole).size};
  b.bytes = (uint8_t *)malloc(b.size);
  if (!b.bytes)
    exit(2);
  memcpy(b.bytes, whole, b.size);
  for (size_t k = 0; k < changes; k++)
    change(&in, &b);
  const size_t inner = word_at(&b, AT_INNER);
  repair(&b, inner);
  if (inner > 0)
    repair(&b, 0);
  const size_t given = cut < 248 ? b.size : fuzz_u32(&in) % (b.size + 1);
  const nsvcd_result result = nsvcd_body_load(b.bytes, given, &body);
  const int refused = result == NSVCD_ERROR_BODY || result == NSVCD_ERROR_VERSION;
  FUZZ_CHECK(result == NSVCD_OK || (refused && !body));
  if (!result) {
    fuzz_taken++;
    use(&in, body);
  }
  free(b.bytes);
  return 0;
}
