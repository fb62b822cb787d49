// neuralsvcd.c - the library compiled by itself, for those who link it: what make, CMake and Meson build.
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "neuralsvcd.h"
#include "extras/neuralsvcd_certify.h"
#include "extras/neuralsvcd_robot.h"
#include "extras/neuralsvcd_world.h"
