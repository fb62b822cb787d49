// libm as WP is told of it: each function gives a number for any numbers and writes nothing.
#ifndef __FC_MATH
#define __FC_MATH
/*@ assigns \result \from x; */
double fabs(double x);
/*@ assigns \result \from x; */
double sqrt(double x);
/*@ assigns \result \from x; */
double sin(double x);
/*@ assigns \result \from x; */
double cos(double x);
/*@ assigns \result \from y, x; */
double atan2(double y, double x);
/*@ assigns \result \from x, sign; */
double copysign(double x, double sign);
#endif
