/* supervise.c - see supervise.h; seccomp_unotify(2). */
#include "supervise.h"

#include <errno.h>
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { NO_MEANS = 99 };

#define IF_EQUAL(value, then, otherwise)                                                           \
  BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)(value), then, otherwise)
#define ANSWER(action) BPF_STMT(BPF_RET | BPF_K, action)
#define ASK_ABOUT(call) IF_EQUAL(call, 0, 1), ANSWER(SECCOMP_RET_USER_NOTIF)

/* In the child: from here on the parent is asked. Returns the descriptor to answer through. */
static int install_filter(void) {
  struct sock_filter program[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, (uint32_t)offsetof(struct seccomp_data, nr)),
#ifdef SYS_rename /* of older architectures */
      ASK_ABOUT(SYS_rename),
      ASK_ABOUT(SYS_mkdir),
      ASK_ABOUT(SYS_link),
      ASK_ABOUT(SYS_symlink),
#endif
      ASK_ABOUT(SYS_renameat),
      ASK_ABOUT(SYS_renameat2),
      ASK_ABOUT(SYS_mkdirat),
      ASK_ABOUT(SYS_linkat),
      ASK_ABOUT(SYS_symlinkat),
      ASK_ABOUT(SYS_openat),
      ASK_ABOUT(SYS_write),
      ASK_ABOUT(SYS_pwrite64),
      ASK_ABOUT(SYS_writev),
      ASK_ABOUT(SYS_fsync),
      ASK_ABOUT(SYS_ftruncate),
      ANSWER(SECCOMP_RET_ALLOW),
  };
  const struct sock_fprog filter = {sizeof program / sizeof *program, program};
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  return (int)syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_NEW_LISTENER,
                      &filter);
}

static bool is_rename(const struct seccomp_data *call) {
#ifdef SYS_rename
  if (call->nr == SYS_rename) return true;
#endif
  return call->nr == SYS_renameat || call->nr == SYS_renameat2;
}

/* What is no file on a disk and no pipe: a display, memory of a driver. */
static bool is_elsewhere(pid_t pid, uint64_t descriptor) {
  static const char *const elsewhere[] = {"socket:", "anon_inode:", "/memfd:", "/dev/"};
  char link[64], to[16] = "";
  snprintf(link, sizeof link, "/proc/%d/fd/%d", (int)pid, (int)descriptor);
  if (readlink(link, to, sizeof to - 1) < 0) return false;
  for (size_t k = 0; k < sizeof elsewhere / sizeof *elsewhere; ++k)
    if (!strncmp(to, elsewhere[k], strlen(elsewhere[k]))) return true;
  return false;
}

static bool changes_files(pid_t pid, const struct seccomp_data *call) {
  const uint64_t creating = O_CREAT | (O_TMPFILE & ~O_DIRECTORY);
  if (call->nr == SYS_openat) return (call->args[2] & creating) != 0;
  bool writes = call->nr == SYS_write || call->nr == SYS_pwrite64 || call->nr == SYS_writev;
  if (!writes && call->nr != SYS_fsync && call->nr != SYS_ftruncate) return true;
  if (writes && call->args[0] == STDERR_FILENO) return false;
  return !is_elsewhere(pid, call->args[0]);
}

/* A message of a byte and a descriptor. */
struct message {
  char byte;
  struct iovec some;
  union {
    struct cmsghdr header;
    char room[CMSG_SPACE(sizeof(int))];
  } carrier;
};

static struct msghdr header_of(struct message *message) {
  *message = (struct message){.some = {&message->byte, 1}};
  return (struct msghdr){.msg_iov = &message->some,
                         .msg_iovlen = 1,
                         .msg_control = message->carrier.room,
                         .msg_controllen = sizeof message->carrier.room};
}

static void send_descriptor(int through, int descriptor) {
  struct message message;
  struct msghdr sent = header_of(&message);
  struct cmsghdr *header = CMSG_FIRSTHDR(&sent);
  header->cmsg_level = SOL_SOCKET;
  header->cmsg_type = SCM_RIGHTS;
  header->cmsg_len = CMSG_LEN(sizeof descriptor);
  memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
  sendmsg(through, &sent, 0);
}

/* -1 where the other end was closed without sending any. */
static int receive_descriptor(int through) {
  struct message message;
  struct msghdr received = header_of(&message);
  int descriptor = -1;
  if (recvmsg(through, &received, MSG_CMSG_CLOEXEC) != 1) return -1;
  const struct cmsghdr *header = CMSG_FIRSTHDR(&received);
  if (header) memcpy(&descriptor, CMSG_DATA(header), sizeof descriptor);
  return descriptor;
}

static void redirect(const char *path, int flags, int descriptor) {
  int file = open(path, flags | O_CLOEXEC, 0666);
  if (file < 0 || dup2(file, descriptor) < 0) _exit(NO_MEANS);
}

/* In the child: never returns. */
static void become(const struct supervised *program, int through) {
  redirect(program->in ? program->in : "/dev/null", O_RDONLY, STDIN_FILENO);
  redirect(program->out, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  redirect(program->err, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, STDERR_FILENO);
  int ends[2];
  if (program->closed_pipe && pipe2(ends, O_CLOEXEC) == 0) {
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
  }
  int listener = install_filter();
  if (listener >= 0) send_descriptor(through, listener);
  close(listener);
  close(through);
  if (listener >= 0) execv(program->argv[0], program->argv);
  _exit(NO_MEANS);
}

/* Answers one question. */
static void answer(int listener, pid_t pid, const struct supervised *program,
                   struct outcome *outcome) {
  struct seccomp_notif asked = {0};
  if (ioctl(listener, SECCOMP_IOCTL_NOTIF_RECV, &asked) != 0) return;
  struct seccomp_notif_resp reply = {.id = asked.id, .flags = SECCOMP_USER_NOTIF_FLAG_CONTINUE};
  bool own = (pid_t)asked.pid == pid;
  if (own != program->of_children && changes_files((pid_t)asked.pid, &asked.data) &&
      (program->renames_too || !is_rename(&asked.data))) {
    long number = ++outcome->calls;
    if (program->fail_from && number >= program->fail_from && number <= program->fail_to) {
      reply.flags = 0;
      reply.error = -ENOSPC;
    }
  }
  ioctl(listener, SECCOMP_IOCTL_NOTIF_SEND, &reply);
}

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

struct outcome supervise(const struct supervised *program) {
  struct outcome outcome = {0};
  int ends[2];
  double end = now() + program->seconds;
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    return (struct outcome){.no_means = true};
  pid_t pid = fork();
  if (pid == 0) {
    setpgid(0, 0);
    become(program, ends[1]);
  }
  close(ends[1]);
  int listener = receive_descriptor(ends[0]);
  close(ends[0]);
  outcome.no_means = listener < 0;
  /* Until nobody is left to ask: the children outlive the program by a moment. */
  for (struct pollfd wait = {listener, POLLIN, 0}; listener >= 0 && !(wait.revents & POLLHUP);) {
    poll(&wait, 1, 1000);
    if (wait.revents & POLLIN) answer(listener, pid, program, &outcome);
    if (now() < end) continue;
    outcome.timeout = true;
    kill(-pid, SIGKILL);
    kill(pid, SIGKILL);
    break;
  }
  if (listener >= 0) close(listener);
  waitpid(pid, &outcome.status, 0);
  return outcome;
}
