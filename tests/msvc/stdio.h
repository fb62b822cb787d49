// What neuralsvcd.h uses of <stdio.h>. Microsoft calls fopen unsafe, and with /sdl that is an error.
#pragma once
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif
typedef struct FILE FILE;
__declspec(deprecated("fopen: C4996")) FILE *fopen(const char *, const char *);
int fopen_s(FILE **, const char *, const char *);
size_t fread(void *, size_t, size_t, FILE *);
int ferror(FILE *);
int fclose(FILE *);
#ifdef __cplusplus
}
#endif
