// Vectors (3), unit quaternions (4) x y z w and matrices (9), row-major, as arrays of floats: what
// tests and peers calculate with. No output may be an input. Nothing of the library is used.
#ifndef ARRAYS_H
#define ARRAYS_H
#include <math.h>
#include <stddef.h>

static inline float length3(const float *a) {
  return sqrtf(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}
static inline void sub3(const float *a, const float *b, float *out) {
  for (size_t k = 0; k < 3; k++) out[k] = a[k] - b[k];
}
static inline void mul33_vec(const float *m, const float *a, float *out) {
  for (size_t k = 0; k < 3; k++)
    out[k] = m[3 * k] * a[0] + m[3 * k + 1] * a[1] + m[3 * k + 2] * a[2];
}
static inline void mul33(const float *a, const float *b, float *out) {
  for (size_t i = 0; i < 9; i++) {
    const float *row = a + i / 3 * 3;
    const float *column = b + i % 3;
    out[i] = row[0] * column[0] + row[1] * column[3] + row[2] * column[6];
  }
}
static inline void transpose33(const float *m, float *out) {
  for (size_t i = 0; i < 9; i++) out[i] = m[i % 3 * 3 + i / 3];
}
static inline void matrix_of_quat(const float *q, float *m) {
  const float x = q[0];
  const float y = q[1];
  const float z = q[2];
  const float w = q[3];
  m[0] = 1 - 2 * (y * y + z * z);
  m[1] = 2 * (x * y - z * w);
  m[2] = 2 * (x * z + y * w);
  m[3] = 2 * (x * y + z * w);
  m[4] = 1 - 2 * (x * x + z * z);
  m[5] = 2 * (y * z - x * w);
  m[6] = 2 * (x * z - y * w);
  m[7] = 2 * (y * z + x * w);
  m[8] = 1 - 2 * (x * x + y * y);
}
static inline void normalize_quat(const float *q, float *out) {
  const float scale = 1 / sqrtf(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (size_t k = 0; k < 4; k++) out[k] = q[k] * scale;
}

#endif
