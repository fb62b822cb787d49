// print.h - what the programs print: numbers, and measurements as row.awk and memory.awk read them.
#ifndef PRINT_H
#define PRINT_H
#include "board.h"

static void print_number(uint64_t number) {
  char text[21];
  char *digit = text + sizeof text - 1;
  *digit = 0;
  do {
    *--digit = (char)('0' + number % 10);
    number /= 10;
  } while (number > 0);
  board_print(digit);
}

static void print_measurement(const char *method, const char *what, uint64_t amount) {
  board_print("# ");
  board_print(method);
  board_print(" ");
  board_print(what);
  board_print(" ");
  print_number(amount);
  board_print("\n");
}
#endif
