#include "viewer/viewer_window.h"

#include <stdio.h>
#include <stdlib.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

struct viewer_window {
  GLFWwindow *window;
  struct viewer_state *state;
  double at[2]; /* of the mouse */
};

static char trouble[256]; /* what GLFW complained about first */

static void note_trouble(int code, const char *text) {
  (void)code;
  if (!*trouble) snprintf(trouble, sizeof trouble, "%s", text);
}

static void on_key(GLFWwindow *handle, int code, int scan, int action, int modifiers) {
  static const int keys[][2] = {
      {GLFW_KEY_LEFT, VIEWER_KEY_LEFT},       {GLFW_KEY_RIGHT, VIEWER_KEY_RIGHT},
      {GLFW_KEY_UP, VIEWER_KEY_UP},           {GLFW_KEY_DOWN, VIEWER_KEY_DOWN},
      {GLFW_KEY_PAGE_UP, VIEWER_KEY_PAGE_UP}, {GLFW_KEY_PAGE_DOWN, VIEWER_KEY_PAGE_DOWN},
      {GLFW_KEY_TAB, VIEWER_KEY_TAB},         {GLFW_KEY_ESCAPE, VIEWER_KEY_ESCAPE}};
  struct viewer_window *window = glfwGetWindowUserPointer(handle);
  (void)scan;
  for (size_t k = 0; k < sizeof keys / sizeof *keys && action != GLFW_RELEASE; ++k)
    if (keys[k][0] == code)
      viewer_state_key(window->state, keys[k][1], (modifiers & GLFW_MOD_SHIFT) != 0);
}

static void on_character(GLFWwindow *handle, unsigned character) {
  struct viewer_window *window = glfwGetWindowUserPointer(handle);
  if (character < 128) viewer_state_key(window->state, (int)character, false);
}

static void on_mouse(GLFWwindow *handle, double x, double y) {
  struct viewer_window *window = glfwGetWindowUserPointer(handle);
  bool left = glfwGetMouseButton(handle, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  bool right = glfwGetMouseButton(handle, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
  int width, height;
  glfwGetWindowSize(handle, &width, &height);
  if ((left || right) && width > 0)
    viewer_state_drag(window->state, (x - window->at[0]) / width, (y - window->at[1]) / width,
                      right);
  window->at[0] = x;
  window->at[1] = y;
}

static void on_wheel(GLFWwindow *handle, double right, double away) {
  struct viewer_window *window = glfwGetWindowUserPointer(handle);
  (void)right;
  viewer_state_scroll(window->state, away);
}

static void on_close(GLFWwindow *handle) {
  struct viewer_window *window = glfwGetWindowUserPointer(handle);
  window->state->quit = true;
}

static enum result fail(const char *what, struct error *error) {
  result_one_line(trouble);
  return result_fail(error, RESULT_IO,
                     "%s%s%s; `renderslab image' with the same arguments makes pictures without",
                     what, *trouble ? ": " : "", trouble);
}

static enum result open_window(int width, int height, struct viewer_window *window,
                               struct error *error) {
  glfwSetErrorCallback(note_trouble);
  if (!glfwInit()) return fail("there is no display for a window", error);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  window->window = glfwCreateWindow(width, height, "renderslab", NULL, NULL);
  if (!window->window) return fail("there is no window with OpenGL 4.3", error);
  glfwSetWindowUserPointer(window->window, window);
  glfwSetKeyCallback(window->window, on_key);
  glfwSetCharCallback(window->window, on_character);
  glfwSetCursorPosCallback(window->window, on_mouse);
  glfwSetScrollCallback(window->window, on_wheel);
  glfwSetWindowCloseCallback(window->window, on_close);
  glfwMakeContextCurrent(window->window);
  return RESULT_OK;
}

enum result viewer_window_create(int width, int height, struct viewer_state *state,
                                 struct viewer_window **window, struct error *error) {
  *window = calloc(1, sizeof **window);
  if (!*window) return result_no_memory(error);
  (*window)->state = state;
  enum result result = open_window(width, height, *window, error);
  if (result != RESULT_OK) {
    viewer_window_free(*window);
    *window = NULL;
  }
  return result;
}

void viewer_window_free(struct viewer_window *window) {
  if (!window) return;
  if (window->window) glfwDestroyWindow(window->window);
  glfwTerminate();
  free(window);
}

void viewer_window_size(const struct viewer_window *window, int size[2]) {
  glfwGetFramebufferSize(window->window, &size[0], &size[1]);
}

void viewer_window_events(struct viewer_window *window, bool wait) {
  (void)window;
  if (wait)
    glfwWaitEvents();
  else
    glfwPollEvents();
}

void viewer_window_show(struct viewer_window *window) {
  glfwSwapBuffers(window->window);
}
