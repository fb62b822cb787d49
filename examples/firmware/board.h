// board.h - what the firmware needs of its machine: board.c has it for Cortex-M, host.c for a PC.
#ifndef BOARD_H
#define BOARD_H

#include <stddef.h>
#include <stdint.h>

// Text goes to whoever watches: a debugger, QEMU, a terminal.
void board_print(const char *text);

// 1 if the two measurements below are true. Nothing is measured otherwise.
int board_measures(void);

// Instructions run so far, to within 40. Starts anew after 170 thousand million.
uint64_t board_instructions(void);

// The first paints what is free of the stack. The second: bytes of the stack in use at the deepest
// since then, those of all callers included.
void board_stack_paint(void);
size_t board_stack_used(void);

#endif
