// files.h - files of a command line: read whole up to a limit, "-" is standard input, names are
// UTF-8 on Windows as well; messages that leave a terminal as it is; how far long work has come.
// Define PROGRAM, the name in messages, and _POSIX_C_SOURCE 200112L before anything.
#ifndef NSVCD_SCENERY_FILES_H
#define NSVCD_SCENERY_FILES_H

#include <errno.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "clock.h"  // windows.h as well
#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <shellapi.h>
#if defined(_MSC_VER)
#pragma comment(lib, "shell32")
#endif
#else
#include <unistd.h>
#endif

// ---------------------------------------------------------------------------------------- messages

// Bytes of the character of UTF-8 at p, which a terminal may be shown; 0: it is none.
static size_t shown_character(const unsigned char *p) {
  if (p[0] < 0x80) return p[0] >= 32 && p[0] != 127;
  const size_t length = p[0] >= 0xf0 ? 4 : p[0] >= 0xe0 ? 3 : 2;
  if (p[0] < 0xc2 || p[0] > 0xf4) return 0;
  for (size_t k = 1; k < length; k++) {
    if ((p[k] & 0xc0) != 0x80) return 0;
  }
  // 0x80 to 0x9f are controls too
  return p[0] == 0xc2 && p[1] < 0xa0 ? 0 : length;
}

// Replaces what a terminal may not be shown by '?': texts come from files, and a file may hold
// anything.
static void make_shown(char *text) {
  while (*text) {
    const size_t length = shown_character((const unsigned char *)text);
    if (!length) *text = '?';
    text += length ? length : 1;
  }
}

// Where what is a part of another program puts the last complaint, for that to tell; NULL: it is printed.
static char *complaint;
static size_t complaint_size;

// Prints "PROGRAM: ..." and returns 0: `return complain(...)` is how every reader below fails.
static int complain(const char *format, ...) {
  char own[8192];
  char *text = complaint ? complaint : own;
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, complaint ? complaint_size : sizeof own, format, arguments);
  va_end(arguments);
  make_shown(text);
  if (!complaint) fprintf(stderr, PROGRAM ": %s\n", text);
  return 0;
}

// The exit status of a program that cannot go on. It is another one where 1 is an answer (svcd
// sweep --exit-code).
static int status_of_failure = 1;

// A tool may give up when there is no memory; the library never does.
static void give_up(void) {
  complaint = NULL;  // who would tell it ends too
  complain("out of memory");
  exit(status_of_failure);
}

// Memory for bodies and workspaces: malloc's is aligned for any type, and so to NSVCD_ALIGNMENT.
static void *allocate(size_t size) {
  void *memory = malloc(size ? size : 1);
  if (!memory) give_up();
  return memory;
}

// ------------------------------------------------------------------------------------------- files

#define MOST_BYTES ((size_t)512 << 20)  // of a file that is read
#define FIRST_LOOK 65536

// fopen, of a name in UTF-8.
static FILE *open_file(const char *path, const char *mode) {
#if defined(_WIN32)
  wchar_t wide[4096], wide_mode[8];
  if (MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, 4096) &&
      MultiByteToWideChar(CP_UTF8, 0, mode, -1, wide_mode, 8))
    return _wfopen(wide, wide_mode);
  errno = EINVAL;
  return NULL;
#else
  return fopen(path, mode);
#endif
}

// The arguments of main in UTF-8; on Windows they come in another code.
static void take_arguments(int *argc, char ***argv) {
#if defined(_WIN32)
  LPWSTR *wide = CommandLineToArgvW(GetCommandLineW(), argc);
  *argv = (char **)allocate(((size_t)*argc + 1) * sizeof **argv);
  for (int i = 0; i < *argc; i++) {
    const int size = WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, NULL, 0, NULL, NULL);
    (*argv)[i] = (char *)allocate((size_t)size);
    WideCharToMultiByte(CP_UTF8, 0, wide[i], -1, (*argv)[i], size, NULL, NULL);
  }
  (*argv)[*argc] = NULL;
  SetConsoleOutputCP(CP_UTF8);
#else
  (void)argc;
  (void)argv;
#endif
}

static int is_standard_input(const char *path) {
  return strcmp(path, "-") == 0;
}
// A file's name in messages.
static const char *shown_name(const char *path) {
  return is_standard_input(path) ? "standard input" : path;
}

// Reads a whole file, aligned, with a 0 behind it. Returns NULL after a complaint. from: what asks
// for it, for messages. look: refuses a file, with a complaint, by its beginning; may be NULL.
static char *read_file(const char *from, const char *path, size_t *size,
                       int (*look)(const char *from, const char *path, const char *bytes,
                                   size_t size)) {
  FILE *file = is_standard_input(path) ? stdin : open_file(path, "rb");
  char *text = NULL;
  size_t capacity = 0;
  int good = 1;
  *size = 0;
  if (!file) complain("%s%s: %s", from, path, strerror(errno));
  if (!file) return NULL;
#if defined(_WIN32)
  _setmode(_fileno(file), _O_BINARY);
#endif
  while (good && !ferror(file) && !feof(file)) {
    capacity = capacity ? 2 * capacity : FIRST_LOOK + 1;
    char *larger = (char *)realloc(text, capacity);
    if (!larger) {
      good = complain("%s%s: out of memory", from, shown_name(path));
      break;
    }
    text = larger;
    const int is_first = *size == 0;
    *size += fread(text + *size, 1, capacity - *size - 1, file);
    text[*size] = 0;
    if (is_first && look) good = look(from, shown_name(path), text, *size);
    if (*size > MOST_BYTES)
      good = complain("%s%s: larger than %zu MB, the most that is read", from, shown_name(path),
                      MOST_BYTES >> 20);
  }
  if (good && ferror(file)) good = complain("%s%s: %s", from, shown_name(path), strerror(errno));
  if (file != stdin) fclose(file);
  if (good) return text;
  free(text);
  return NULL;
}

// Closes a file that was written. Returns 0 after a complaint.
static int close_written(FILE *file, const char *path) {
  const int is_written = fflush(file) == 0 && !ferror(file);
  return fclose(file) == 0 && is_written ? 1 : complain("%s: cannot be written", path);
}

// ---------------------------------------------------------------------------------------- progress

// A line on a terminal, if the work takes more than a second: "answering: 120 of 600".
typedef struct progress_bar {
  const char *what;
  size_t of;
  double next;  // time of the next line; 0: not yet begun
  int is_told;
} progress_bar;

static int is_terminal(void) {
#if defined(_WIN32)
  return _isatty(_fileno(stderr));
#else
  return isatty(fileno(stderr));
#endif
}

static void progress_step(progress_bar *p, size_t done) {
  const double now = seconds();
  if (p->next <= 0) p->next = now + 1;
  if (now < p->next || !is_terminal()) return;
  p->next = now + 0.2;
  p->is_told = 1;
  fprintf(stderr, "\r" PROGRAM ": %s: %zu of %zu ", p->what, done, p->of);
}
// Clears the line.
static void progress_end(const progress_bar *p) {
  if (p->is_told) fprintf(stderr, "\r%60s\r", "");
}

#endif
