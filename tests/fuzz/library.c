// The library, once for all fuzz targets.
#define NEURALSVCD_IMPLEMENTATION
#include "../../neuralsvcd.h"
