#include "gl/gl_program.h"

#include <epoxy/gl.h>

#include "gl/gl_context.h"

static enum result compile(GLenum kind, const char *text, const char *defines, GLuint program,
                           struct error *error) {
  const char *texts[] = {"#version 430 core\n", defines, text};
  GLuint shader = glCreateShader(kind);
  GLint compiled = 0;
  glShaderSource(shader, 3, texts, NULL);
  glCompileShader(shader);
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  glAttachShader(program, shader);
  if (compiled) {
    glDeleteShader(shader);
    return RESULT_OK;
  }
  char log[256] = "";
  glGetShaderInfoLog(shader, sizeof log, NULL, log);
  glDeleteShader(shader);
  result_one_line(log);
  return gl_fail(error, RESULT_IO, "the driver does not take a shader: %s", log);
}

enum result gl_program_make(const char *vertex, const char *fragment, const char *defines,
                            unsigned *program, struct error *error) {
  *program = glCreateProgram();
  enum result result = compile(GL_VERTEX_SHADER, vertex, defines, *program, error);
  if (result == RESULT_OK) result = compile(GL_FRAGMENT_SHADER, fragment, defines, *program, error);
  if (result != RESULT_OK) return result;
  GLint linked = 0;
  glLinkProgram(*program);
  glGetProgramiv(*program, GL_LINK_STATUS, &linked);
  if (linked) return RESULT_OK;
  return gl_fail(error, RESULT_IO, "the driver does not link a shader");
}

void gl_set_int(unsigned program, const char *name, int value) {
  glProgramUniform1i(program, glGetUniformLocation(program, name), value);
}

void gl_set_floats(unsigned program, const char *name, int count, const double *values) {
  GLint place = glGetUniformLocation(program, name);
  float v[4] = {0};
  for (int k = 0; k < count; ++k) v[k] = (float)values[k];
  if (count == 1) glProgramUniform1fv(program, place, 1, v);
  if (count == 2) glProgramUniform2fv(program, place, 1, v);
  if (count == 3) glProgramUniform3fv(program, place, 1, v);
  if (count == 4) glProgramUniform4fv(program, place, 1, v);
}

void gl_set_frame(unsigned program, const double frame[3][3]) {
  float columns[9];
  for (int k = 0; k < 9; ++k) columns[k] = (float)frame[k / 3][k % 3];
  glProgramUniformMatrix3fv(program, glGetUniformLocation(program, "frame"), 1, GL_FALSE, columns);
}

void gl_set_texture(unsigned program, const char *name, int unit, unsigned target,
                    unsigned texture) {
  glActiveTexture(GL_TEXTURE0 + (GLenum)unit);
  glBindTexture(target, texture);
  gl_set_int(program, name, unit);
}
