// In: linear equations whose matrix is positive definite. Out: their solution.
#pragma once
#include "chain.h"

// rows of a matrix, at most
#define NSVCD__MOST_ROWS 7

// Solves m x = b, of so many rows, by Cholesky's factors, of which m keeps the lower one.
static void nsvcd__solve_rows(double m[NSVCD__MOST_ROWS][NSVCD__MOST_ROWS], const double *b,
                              size_t rows, double *x) {
  for (size_t i = 0; i < rows; i++) {
    for (size_t k = 0; k <= i; k++) {
      double sum = m[i][k];
      for (size_t l = 0; l < k; l++) sum -= m[i][l] * m[k][l];
      m[i][k] = i == k ? sqrt(nsvcd__max(sum, 1e-300)) : sum / m[k][k];
    }
  }
  for (size_t i = 0; i < rows; i++) {
    x[i] = b[i];
    for (size_t k = 0; k < i; k++) x[i] -= m[i][k] * x[k];
    x[i] /= m[i][i];
  }
  for (size_t i = rows; i-- > 0;) {
    for (size_t k = i + 1; k < rows; k++) x[i] -= m[k][i] * x[k];
    x[i] /= m[i][i];
  }
}
