// board.c - startup, output and a clock on the MPS2 boards, Cortex-M4F and M7, as QEMU has them.
//
// Only the clock is the MPS2's own. Startup is that of any Cortex-M with an FPU. Output is
// semihosting, which debuggers understand too.
#include "board.h"

int main(void);
void reset(void);

// ------------------------------------------------------------------------------------- semihosting

#define SYS_WRITE0 0x04
#define SYS_EXIT_EXTENDED 0x20
#define APPLICATION_EXIT 0x20026u

static void semihost(int operation, const void *argument) {
  register int r0 __asm__("r0") = operation;
  register const void *r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
}

void board_print(const char *text) {
  semihost(SYS_WRITE0, text);
}

// Ends QEMU with this exit status.
static void finish(int status) {
  const uint32_t reason[2] = {APPLICATION_EXIT, (uint32_t)status};
  semihost(SYS_EXIT_EXTENDED, reason);
  for (;;) {
  }
}

// ------------------------------------------------------------------------------------------- clock

// Timer 0 counts down at 25 MHz. With `-icount shift=0` QEMU's time is one nanosecond an
// instruction: 40 a tick.
#define TIMER_CONTROL (*(volatile uint32_t *)0x40000000)
#define TIMER_VALUE (*(volatile uint32_t *)0x40000004)
#define TIMER_RELOAD (*(volatile uint32_t *)0x40000008)
#define PER_TICK 40u

static void start_clock(void) {
  TIMER_RELOAD = 0xffffffffu;
  TIMER_VALUE = 0xffffffffu;
  TIMER_CONTROL = 1;
}

uint64_t board_instructions(void) {
  return (uint64_t)PER_TICK * (0xffffffffu - TIMER_VALUE);
}

// A loop of 2 `rounds` instructions has to count as so many. Without -icount it does not.
int board_measures(void) {
  const uint32_t rounds = 1000000;
  uint32_t left = rounds;
  const uint64_t before = board_instructions();
  __asm__ volatile("1: subs %0, #1\n bne 1b" : "+l"(left) : : "cc");
  const uint64_t taken = board_instructions() - before;
  return taken + 200 > 2 * rounds && taken < 2 * rounds + 200;
}

// ------------------------------------------------------------------------------------------- stack

#define PAINT 0x5ac3c35au

extern uint32_t stack_limit[], stack_top[];  // in mps2.ld

void board_stack_paint(void) {
  uintptr_t here;
  __asm__ volatile("mov %0, sp" : "=r"(here));
  // Volatile, or it becomes a call of memset, whose own frame would be painted over.
  for (volatile uint32_t *word = stack_limit; (uintptr_t)word < here; word++) {
    *word = PAINT;
  }
}

// The bytes of the stack that were used. Not seen is what is reserved, but never written, at the
// very bottom of the deepest frame.
size_t board_stack_used(void) {
  const volatile uint32_t *word = stack_limit;
  while (word < stack_top && *word == PAINT) {
    word++;
  }
  return (size_t)((uintptr_t)stack_top - (uintptr_t)word);
}

// ----------------------------------------------------------------------------------------- startup

extern uint32_t data_begin[], data_end[], data_in_flash[], bss_begin[], bss_end[];  // in mps2.ld

void reset(void) {
  volatile uint32_t *const coprocessor_access = (volatile uint32_t *)0xe000ed88;
  *coprocessor_access |= 0xfu << 20;  // the FPU, before any code that could use it
  __asm__ volatile("dsb\n isb");
  const uint32_t *from = data_in_flash;
  for (volatile uint32_t *to = data_begin; to < (volatile uint32_t *)data_end; to++) {
    *to = *from++;
  }
  for (volatile uint32_t *to = bss_begin; to < (volatile uint32_t *)bss_end; to++) {
    *to = 0;
  }
  start_clock();
  finish(main());
}

// An overflow of the stack ends here too, or in a lockup, which ends QEMU: below it is no memory.
static void fault(void) {
  board_print("fault\n");
  finish(3);
}

typedef void handler(void);
typedef struct vector_table {
  uint32_t *stack;
  handler *reset;
  handler *faults[14];  // nothing else ever happens: no interrupt is enabled
} vector_table;

__attribute__((section(".vectors"), used)) static const vector_table vectors = {
    stack_top,
    reset,
    {fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault,
     fault},
};
