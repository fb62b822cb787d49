// host.c - the board of firmware.c on a PC, for answers to compare with. Nothing is measured here.
#include <stdio.h>

#include "board.h"

void board_print(const char *text) {
  fputs(text, stdout);
}
int board_measures(void) {
  return 0;
}
uint64_t board_instructions(void) {
  return 0;
}
void board_stack_paint(void) {
}
size_t board_stack_used(void) {
  return 0;
}
