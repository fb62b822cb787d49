// What neuralsvcd.h uses of <math.h>, as Microsoft's has it: neither M_PI nor what is GNU's.
#pragma once
#ifdef __cplusplus
extern "C" {
#endif
#define HUGE_VALF ((float)(1e+300 * 1e+300))
#define INFINITY HUGE_VALF
#define HUGE_VAL ((double)HUGE_VALF)
#define ONE(name) \
  double name(double); \
  float name##f(float)
#define TWO(name) \
  double name(double, double); \
  float name##f(float, float)
ONE(fabs); ONE(sqrt); ONE(floor); ONE(ceil); ONE(sin); ONE(cos); ONE(tan); ONE(asin); ONE(acos);
ONE(atan); ONE(exp); ONE(log); ONE(log2); ONE(tanh); ONE(round);
TWO(fmax); TWO(fmin); TWO(atan2); TWO(nextafter); TWO(pow); TWO(fmod); TWO(copysign);
double frexp(double, int *);
double ldexp(double, int);
long lrint(double);
long lrintf(float);
#undef ONE
#undef TWO
#ifdef __cplusplus
}
#endif
