// gif.h - films as GIF, which every browser plays: frames of 24-bit colours, each shown as long as it
// says, again and again. What differs from the frame before is all that a frame stores.
//
//   gif_film film = {720, 440, NULL, NULL, 0};
//   gif_add(&film, rgb, 4);  // copied; hundredths of a second
//   gif_write(&film, "film.gif"), gif_free(&film);
#ifndef NSVCD_SCENERY_GIF_H
#define NSVCD_SCENERY_GIF_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define GIF_COLOURS 255  // and one that means: as before
#define GIF_CODES 4096   // of LZW, at most

typedef struct gif_film {
  int width, height;
  uint16_t *pixels;  // (count, height, width): 5 bits of red, green and blue
  int *delays;       // (count)
  int count;
} gif_film;

static void gif_free(gif_film *film) {
  free(film->pixels);
  free(film->delays);
  memset(film, 0, sizeof *film);
}

// rgb: (height, width, 3). Returns 0 without memory.
static int gif_add(gif_film *film, const uint8_t *rgb, int delay) {
  const size_t size = (size_t)film->width * (size_t)film->height;
  const size_t count = (size_t)film->count;
  uint16_t *pixels = (uint16_t *)realloc(film->pixels, (count + 1) * size * sizeof *pixels);
  if (pixels) film->pixels = pixels;
  int *delays = (int *)realloc(film->delays, (count + 1) * sizeof *delays);
  if (delays) film->delays = delays;
  if (!pixels || !delays) return 0;
  for (size_t i = 0; i < size; i++) {
    const int red = rgb[3 * i] >> 3;
    const int green = rgb[3 * i + 1] >> 3;
    const int blue = rgb[3 * i + 2] >> 3;
    pixels[count * size + i] = (uint16_t)(red << 10 | green << 5 | blue);
  }
  delays[film->count++] = delay;
  return 1;
}

// ----------------------------------------------------------------------------------------- colours

static int gif_channel(int colour, int channel) {
  return colour >> (10 - 5 * channel) & 31;
}

static int gif_difference(int a, int b) {
  int sum = 0;
  for (int k = 0; k < 3; k++) {
    const int d = gif_channel(a, k) - gif_channel(b, k);
    sum += d * d;
  }
  return sum;
}

// The palette: again and again the most frequent colour that differs enough from all chosen so far;
// when there is none left, less is enough. Returns how many there are.
static int gif_choose(const gif_film *film, int *palette) {
  static size_t frequency[1 << 15];
  const size_t size = (size_t)film->width * (size_t)film->height * (size_t)film->count;
  int count = 0;
  memset(frequency, 0, sizeof frequency);
  for (size_t i = 0; i < size; i++) frequency[film->pixels[i]]++;
  for (int enough = 12; enough > 0; enough /= 2) {
    for (;;) {
      int best = -1;
      for (int colour = 0; colour < 1 << 15; colour++) {
        int differs = frequency[colour] > 0 && (best < 0 || frequency[colour] > frequency[best]);
        for (int i = 0; i < count && differs; i++)
          differs = gif_difference(palette[i], colour) >= enough;
        if (differs) best = colour;
      }
      if (best < 0 || count == GIF_COLOURS) break;
      palette[count++] = best;
    }
  }
  return count;
}

// For each colour the nearest one of the palette.
static void gif_map(const int *palette, int count, uint8_t *nearest) {
  for (int colour = 0; colour < 1 << 15; colour++) {
    int best = 0;
    for (int i = 1; i < count; i++)
      if (gif_difference(palette[i], colour) < gif_difference(palette[best], colour)) best = i;
    nearest[colour] = (uint8_t)best;
  }
}

// --------------------------------------------------------------------------------------------- LZW

typedef struct gif_codes {
  FILE *file;
  uint8_t block[255];
  int filled;     // bytes of the block
  uint32_t bits;  // bits that are no byte yet
  int bit_count;
  int width;  // bits of a code
} gif_codes;

static void gif_flush(gif_codes *out) {
  if (out->filled) fputc(out->filled, out->file);
  fwrite(out->block, 1, (size_t)out->filled, out->file);
  out->filled = 0;
}
static void gif_code(gif_codes *out, int code) {
  out->bits |= (uint32_t)code << out->bit_count;
  out->bit_count += out->width;
  for (; out->bit_count >= 8; out->bit_count -= 8, out->bits >>= 8) {
    out->block[out->filled++] = (uint8_t)out->bits;
    if (out->filled == 255) gif_flush(out);
  }
}

// Welch 1984, with codes of 9 to 12 bits: a string that was seen gets a code, and when there are no
// more codes all are forgotten.
static void gif_compress(FILE *file, const uint8_t *indices, size_t count) {
  static uint16_t next[GIF_CODES][256];  // the code of a string and one index more; 0: not seen
  gif_codes out = {file, {0}, 0, 0, 0, 9};
  int known = 258;  // 256 forgets all, 257 ends
  int string = indices[0];
  fputc(8, file);
  gif_code(&out, 256);
  memset(next, 0, sizeof next);
  for (size_t i = 1; i < count; i++) {
    const int index = indices[i];
    if (next[string][index]) {
      string = next[string][index];
      continue;
    }
    gif_code(&out, string);
    if (known == 1 << out.width && out.width < 12) out.width++;
    if (known < GIF_CODES) {
      next[string][index] = (uint16_t)known++;
    } else {
      gif_code(&out, 256);
      memset(next, 0, sizeof next);
      known = 258;
      out.width = 9;
    }
    string = index;
  }
  gif_code(&out, string);
  if (known == 1 << out.width && out.width < 12) out.width++;
  gif_code(&out, 257);
  out.width = 7;
  gif_code(&out, 0);
  gif_flush(&out);
  fputc(0, file);
}

// ------------------------------------------------------------------------------------------ frames

static void gif_number(FILE *file, int number) {
  fputc(number & 255, file);
  fputc(number >> 8, file);
}

// The rectangle that holds all that differs from the frame before; what is the same is transparent.
static void gif_frame(FILE *file, const gif_film *film, int frame, const uint8_t *nearest) {
  const size_t size = (size_t)film->width * (size_t)film->height;
  const uint16_t *now = film->pixels + (size_t)frame * size;
  const uint16_t *before = frame ? now - size : NULL;
  uint8_t *indices = (uint8_t *)malloc(size);
  int low[2] = {film->width, film->height};
  int high[2] = {1, 1};
  size_t count = 0;
  if (!indices) return;
  for (int y = 0; y < film->height; y++)
    for (int x = 0; x < film->width; x++) {
      const size_t i = (size_t)y * (size_t)film->width + (size_t)x;
      if (before && nearest[now[i]] == nearest[before[i]]) continue;
      if (x < low[0]) low[0] = x;
      if (y < low[1]) low[1] = y;
      if (x >= high[0]) high[0] = x + 1;
      if (y >= high[1]) high[1] = y + 1;
    }
  if (low[0] >= high[0]) low[0] = low[1] = 0;  // all the same
  for (int y = low[1]; y < high[1]; y++)
    for (int x = low[0]; x < high[0]; x++) {
      const size_t i = (size_t)y * (size_t)film->width + (size_t)x;
      const int same = before && nearest[now[i]] == nearest[before[i]];
      indices[count++] = same ? GIF_COLOURS : nearest[now[i]];
    }
  fwrite("\x21\xf9\x04\x05", 1, 4, file);  // stays, and has a transparent colour
  gif_number(file, film->delays[frame]);
  fputc(GIF_COLOURS, file);
  fwrite("\0,", 1, 2, file);
  gif_number(file, low[0]);
  gif_number(file, low[1]);
  gif_number(file, high[0] - low[0]);
  gif_number(file, high[1] - low[1]);
  fputc(0, file);
  gif_compress(file, indices, count);
  free(indices);
}

// Returns 1, or 0 after a message.
static int gif_write(const gif_film *film, const char *path) {
  int palette[GIF_COLOURS + 1] = {0};
  uint8_t *nearest = (uint8_t *)malloc(1 << 15);
  FILE *file = nearest ? fopen(path, "wb") : NULL;
  if (!file) return fprintf(stderr, "%s: cannot be written\n", path), free(nearest), 0;
  gif_map(palette, gif_choose(film, palette), nearest);
  fwrite("GIF89a", 1, 6, file);
  gif_number(file, film->width);
  gif_number(file, film->height);
  fwrite("\xf7\0\0", 1, 3, file);  // a palette of 256
  for (int i = 0; i < 3 * (GIF_COLOURS + 1); i++)
    fputc(gif_channel(palette[i / 3], i % 3) * 255 / 31, file);
  fwrite("!\xff\x0bNETSCAPE2.0\x03\x01\0\0\0", 1, 19, file);  // again and again
  for (int i = 0; i < film->count; i++) gif_frame(file, film, i, nearest);
  fputc(';', file);
  free(nearest);
  const int good = !ferror(file);
  if (fclose(file) == 0 && good) return 1;
  return fprintf(stderr, "%s: cannot be written\n", path), 0;
}

#endif  // NSVCD_SCENERY_GIF_H
