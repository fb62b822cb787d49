// The spline: what it passes through, its derivatives, integrals and weights.
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "../src/body/encode.h"
#include "../src/plan/plan.h"

#include "plan_scene.h"

void test_spline(void);

// The spline in double, of one joint.
static double plan_spline(const float *control, size_t via, double t, size_t derivative) {
  double weights[PLAN_VIA];
  double sum = 0;
  nsvcd__spline_weights(via, t, derivative, weights);
  for (size_t k = 0; k < via + 2; k++) sum += weights[k] * (double)control[k];
  return sum;
}

// ------------------------------------------------------------------------------------- from within
// What follows reads or changes what no program sees.

// Each order is the derivative of the one below, within every piece; position, velocity and
// acceleration agree on both sides of a via point.
static void plan_spline_derivatives(void) {
  shapes_rng rng = {2};
  double worst = 0;
  for (size_t via = 0; via <= NSVCD_MAX_VIA_POINTS; via++) {
    float control[PLAN_VIA];
    const double last = (double)(via + 1);
    const double h = 1e-4 / last;
    plan_random_numbers(&rng, via + 2, 2, control);
    for (int n = 0; n < 40; n++) {
      const double t =
          ((double)shapes_pick(&rng, (int)via + 1) + shapes_uniform(&rng, 0.01, 0.99)) / last;
      for (size_t derivative = 1; derivative <= 3; derivative++) {
        const double scale = pow(last, (double)derivative);
        const double by_differences = (plan_spline(control, via, t + h, derivative - 1) -
                                       plan_spline(control, via, t - h, derivative - 1)) /
                                      (2 * h);
        const double error =
            fabs(plan_spline(control, via, t, derivative) - by_differences) / scale;
        CHECK_LE(error, 1e-4);
        worst = fmax(worst, error);
      }
    }
    for (size_t k = 1; k <= via; k++) {
      const double at = (double)k / last;
      const double side = 1e-7 / last;
      for (size_t derivative = 0; derivative <= 2; derivative++) {
        const double jump = plan_spline(control, via, at + side, derivative) -
                            plan_spline(control, via, at - side, derivative);
        CHECK_NEAR(jump / pow(last, (double)derivative), 0, 1e-4);
      }
      // At via points the velocity is that of central differences, and the acceleration too.
      const double before = (double)control[k - 1];
      const double here = (double)control[k];
      const double after = (double)control[k + 1];
      CHECK_NEAR(plan_spline(control, via, at, 1) / last, (after - before) / 2, 1e-6);
      CHECK_NEAR(plan_spline(control, via, at, 2) / (last * last), after - 2 * here + before, 1e-6);
    }
  }
  printf("  derivatives against differences: %.1e of the scale at most\n", worst);
}

static void plan_mean_squares_are_integrals(void) {
  shapes_rng rng = {4};
  double worst = 0;
  for (size_t via = 1; via <= NSVCD_MAX_VIA_POINTS; via++) {
    for (size_t derivative = 1; derivative <= 3; derivative++) {
      double form[PLAN_VIA * PLAN_VIA];
      double sum = 0;
      double integral = 0;
      float control[PLAN_VIA];
      const int steps = 100 * (int)(via + 1);
      memset(form, 0, sizeof form);
      nsvcd__add_mean_square(via, derivative, 0.75, form);
      nsvcd__add_mean_square(via, derivative, 0.25, form);  // it adds
      plan_random_numbers(&rng, via + 2, 1, control);
      for (size_t i = 0; i < via + 2; i++) {
        for (size_t j = 0; j < via + 2; j++) {
          sum += form[i * (via + 2) + j] * (double)control[i] * (double)control[j];
          CHECK_NEAR(form[i * (via + 2) + j], form[j * (via + 2) + i],
                     1e-9 * fabs(form[i * (via + 2) + j]) + 1e-9);
        }
      }
      for (int n = 0; n < steps; n++) {
        const double x = plan_spline(control, via, ((double)n + 0.5) / steps, derivative);
        integral += x * x / steps;
      }
      CHECK_NEAR(sum, integral, 2e-3 * integral);
      worst = fmax(worst, fabs(sum / integral - 1));
    }
  }
  printf("  mean squares against the midpoint rule: %.1e of it at most\n", worst);
}

static void plan_cholesky_solves(void) {
  shapes_rng rng = {5};
  for (size_t n = 1; n <= NSVCD_MAX_VIA_POINTS; n++) {
    static double a[PLAN_VIA * PLAN_VIA], root[PLAN_VIA * PLAN_VIA];
    double x[PLAN_VIA], wanted[PLAN_VIA];
    for (size_t k = 0; k < n * n; k++) root[k] = shapes_uniform(&rng, -1, 1);
    for (size_t i = 0; i < n; i++) {
      wanted[i] = shapes_uniform(&rng, -1, 1);
      for (size_t j = 0; j < n; j++) {
        a[i * n + j] = i == j ? 0.5 : 0;
        for (size_t k = 0; k < n; k++) a[i * n + j] += root[i * n + k] * root[j * n + k];
      }
    }
    for (size_t i = 0; i < n; i++) {
      x[i] = 0;
      for (size_t j = 0; j < n; j++) x[i] += a[i * n + j] * wanted[j];
    }
    nsvcd__cholesky(a, n);
    nsvcd__solve_lower(a, n, x);
    nsvcd__solve_upper(a, n, x);
    for (size_t i = 0; i < n; i++) CHECK_NEAR(x[i], wanted[i], 1e-9);
  }
}

void test_spline(void) {
  // from within
  RUN(plan_spline_derivatives);
  RUN(plan_mean_squares_are_integrals);
  RUN(plan_cholesky_solves);
}

CHECK_ALONE(test_spline)
