// SPDX-License-Identifier: BSD-3-Clause
#include "view/gl_object.h"

#include <array>
#include <stdexcept>

namespace view {
namespace {

GlObject compile(GLenum kind, const std::string& defines, const char* body) {
  GlObject shader(glCreateShader(kind), [](GLuint id) { glDeleteShader(id); });
  const std::array<const char*, 3> source{"#version 330 core\n", defines.c_str(), body};
  glShaderSource(shader.id(), static_cast<GLsizei>(source.size()), source.data(), nullptr);
  glCompileShader(shader.id());
  GLint done = 0;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &done);
  if (done == 0) {
    std::array<char, 2000> log{};
    glGetShaderInfoLog(shader.id(), static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw std::runtime_error(std::string("a shader does not compile: ") + log.data());
  }
  return shader;
}

}  // namespace

GlObject make_buffer() {
  GLuint id = 0;
  glGenBuffers(1, &id);
  return {id, [](GLuint of) { glDeleteBuffers(1, &of); }};
}

GlObject make_vertex_array() {
  GLuint id = 0;
  glGenVertexArrays(1, &id);
  return {id, [](GLuint of) { glDeleteVertexArrays(1, &of); }};
}

GlObject make_texture() {
  GLuint id = 0;
  glGenTextures(1, &id);
  return {id, [](GLuint of) { glDeleteTextures(1, &of); }};
}

GlObject make_renderbuffer() {
  GLuint id = 0;
  glGenRenderbuffers(1, &id);
  return {id, [](GLuint of) { glDeleteRenderbuffers(1, &of); }};
}

GlObject make_framebuffer() {
  GLuint id = 0;
  glGenFramebuffers(1, &id);
  return {id, [](GLuint of) { glDeleteFramebuffers(1, &of); }};
}

GlObject make_program(const char* vertex_shader, const char* fragment_shader,
                      const std::vector<std::string>& defined) {
  std::string defines;
  for (const std::string& name : defined) defines += "#define " + name + "\n";
  const GlObject vertex = compile(GL_VERTEX_SHADER, defines, vertex_shader);
  const GlObject fragment = compile(GL_FRAGMENT_SHADER, defines, fragment_shader);
  GlObject program(glCreateProgram(), [](GLuint id) { glDeleteProgram(id); });
  glAttachShader(program.id(), vertex.id());
  glAttachShader(program.id(), fragment.id());
  glLinkProgram(program.id());
  GLint done = 0;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &done);
  if (done == 0) throw std::runtime_error("the shaders do not link");
  return program;
}

GLint uniform(const GlObject& program, const char* name) {
  return glGetUniformLocation(program.id(), name);
}

}  // namespace view
