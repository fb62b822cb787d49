// any_query.h - memory for any question, laid out, for tests that look at what a query does in
// between. After the implementation.
#ifndef ANY_QUERY_H
#define ANY_QUERY_H

#include <stdlib.h>

static nsvcd__query *any_query(void) {
  const nsvcd__needs needs = nsvcd__needs_of(NULL);
  char *memory = (char *)malloc(nsvcd__query_layout(&needs, NULL));
  nsvcd__query *query = (nsvcd__query *)(void *)memory;
  (void)nsvcd__query_layout(&needs, memory);
#ifndef NSVCD_NO_PROOF
  query->solver->intervals = query->intervals;
#endif
  return query;
}

#endif
