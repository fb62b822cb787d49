// trade_mesh.c - the benchmark's mesh hierarchy for trade.c, a file of its own for flags of its own.
#include "../../tests/bench/mesh.h"

const method *trade_hierarchy(void);
const method *trade_hierarchy(void) {
  return &full_mesh_method;
}
