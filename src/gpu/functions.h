#pragma once
// The GL entry points of one context. A reference to them is only handed out on the context's own
// thread (Context::run), so holding one proves that GL may be called.
#include <GL/glcorearb.h>

namespace skylapse::gpu {

class Context;

// Name as in gl<Name>, and as in PFNGL<NAME>PROC.
#define SKYLAPSE_GL_FUNCTIONS(X)                  \
  X(AttachShader, ATTACHSHADER)                   \
  X(BindBufferBase, BINDBUFFERBASE)               \
  X(BindBufferRange, BINDBUFFERRANGE)             \
  X(BindImageTexture, BINDIMAGETEXTURE)           \
  X(BindTextureUnit, BINDTEXTUREUNIT)             \
  X(ClearNamedBufferData, CLEARNAMEDBUFFERDATA)   \
  X(CompileShader, COMPILESHADER)                 \
  X(CreateBuffers, CREATEBUFFERS)                 \
  X(CreateProgram, CREATEPROGRAM)                 \
  X(CreateShader, CREATESHADER)                   \
  X(CreateTextures, CREATETEXTURES)               \
  X(DebugMessageCallback, DEBUGMESSAGECALLBACK)   \
  X(DebugMessageControl, DEBUGMESSAGECONTROL)     \
  X(DeleteBuffers, DELETEBUFFERS)                 \
  X(DeleteProgram, DELETEPROGRAM)                 \
  X(DeleteShader, DELETESHADER)                   \
  X(DeleteTextures, DELETETEXTURES)               \
  X(DispatchCompute, DISPATCHCOMPUTE)             \
  X(Enable, ENABLE)                               \
  X(Finish, FINISH)                               \
  X(GetError, GETERROR)                           \
  X(GetIntegerv, GETINTEGERV)                     \
  X(GetNamedBufferSubData, GETNAMEDBUFFERSUBDATA) \
  X(GetProgramInfoLog, GETPROGRAMINFOLOG)         \
  X(GetProgramiv, GETPROGRAMIV)                   \
  X(GetShaderInfoLog, GETSHADERINFOLOG)           \
  X(GetShaderiv, GETSHADERIV)                     \
  X(GetString, GETSTRING)                         \
  X(GetTextureImage, GETTEXTUREIMAGE)             \
  X(LinkProgram, LINKPROGRAM)                     \
  X(MemoryBarrier, MEMORYBARRIER)                 \
  X(NamedBufferStorage, NAMEDBUFFERSTORAGE)       \
  X(NamedBufferSubData, NAMEDBUFFERSUBDATA)       \
  X(ShaderSource, SHADERSOURCE)                   \
  X(TextureParameteri, TEXTUREPARAMETERI)         \
  X(TextureStorage2D, TEXTURESTORAGE2D)           \
  X(TextureStorage3D, TEXTURESTORAGE3D)           \
  X(TextureSubImage2D, TEXTURESUBIMAGE2D)         \
  X(TextureSubImage3D, TEXTURESUBIMAGE3D)         \
  X(UseProgram, USEPROGRAM)

struct Functions {
#define SKYLAPSE_GL_MEMBER(name, upper) PFNGL##upper##PROC name = nullptr;
  SKYLAPSE_GL_FUNCTIONS(SKYLAPSE_GL_MEMBER)
#undef SKYLAPSE_GL_MEMBER
  Context* context = nullptr;  // whose they are
};

}  // namespace skylapse::gpu
