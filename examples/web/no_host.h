// no_host.h - what printf of wasi-libc would ask a host for, so that a module imports nothing. Only
// snprintf is used, which does not ask.
#ifndef NSVCD_WEB_NO_HOST_H
#define NSVCD_WEB_NO_HOST_H
#include <stdint.h>

int32_t __imported_wasi_snapshot_preview1_fd_close(int32_t fd) {
  return fd;
}
int32_t __imported_wasi_snapshot_preview1_fd_seek(int32_t fd, int64_t to, int32_t from,
                                                  int32_t out) {
  return (void)to, (void)from, (void)out, fd;
}
int32_t __imported_wasi_snapshot_preview1_fd_write(int32_t fd, int32_t list, int32_t count,
                                                   int32_t out) {
  return (void)list, (void)count, (void)out, fd;
}

#endif
