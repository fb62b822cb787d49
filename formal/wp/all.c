#include "math.h"
#include "nsvcd_verify.h"
