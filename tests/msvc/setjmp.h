// What clang's <intrin.h> wants of <setjmp.h>.
#pragma once
typedef int jmp_buf[64];
