// In: six linear equations whose matrix is positive definite. Out: their solution.
#pragma once
#include "chain.h"

// Solves m x = b by Cholesky's factors, of which m keeps the lower one. m is positive definite.
static void nsvcd__solve_six(double m[6][6], const double *b, double *x) {
  for (size_t i = 0; i < 6; i++) {
    for (size_t k = 0; k <= i; k++) {
      double sum = m[i][k];
      for (size_t l = 0; l < k; l++) sum -= m[i][l] * m[k][l];
      m[i][k] = i == k ? sqrt(nsvcd__max(sum, 1e-300)) : sum / m[k][k];
    }
  }
  for (size_t i = 0; i < 6; i++) {
    x[i] = b[i];
    for (size_t k = 0; k < i; k++) x[i] -= m[i][k] * x[k];
    x[i] /= m[i][i];
  }
  for (size_t i = 6; i-- > 0;) {
    for (size_t k = i + 1; k < 6; k++) x[i] -= m[k][i] * x[k];
    x[i] /= m[i][i];
  }
}
