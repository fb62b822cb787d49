// What neuralsvcd.h uses of <string.h>.
#pragma once
#include <stddef.h>
#ifdef __cplusplus
extern "C" {
#endif
void *memcpy(void *, const void *, size_t);
void *memmove(void *, const void *, size_t);
void *memset(void *, int, size_t);
int memcmp(const void *, const void *, size_t);
size_t strlen(const char *);
size_t strcspn(const char *, const char *);
#ifdef __cplusplus
}
const char *strchr(const char *, int);
const void *memchr(const void *, int, size_t);
#else
char *strchr(const char *, int);
void *memchr(const void *, int, size_t);
#endif
