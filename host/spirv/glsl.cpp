#include "host/spirv/glsl.h"

#include "host/spirv/backend.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>

namespace tegument {

namespace {

constexpr int kLeastVersion = 100; // for a text that names none

bool parse(glslang::TShader& shader, const std::string& text) {
    const char* string = text.c_str();
    shader.setStrings(&string, 1);
    return shader.parse(GetDefaultResources(), kLeastVersion, false, EShMsgDefault);
}

} // namespace

std::string checkGlsl(ShaderStage stage, const std::string& text) {
    glslang_hlsl::initialise();
    glslang::TShader shader(static_cast<EShLanguage>(stageNames(stage).model));
    return parse(shader, text) ? "" : shader.getInfoLog();
}

std::string checkGlslProgram(const std::string& vertex, const std::string& pixel) {
    glslang_hlsl::initialise();
    glslang::TShader first(EShLangVertex);
    glslang::TShader second(EShLangFragment);
    if (!parse(first, vertex)) return first.getInfoLog();
    if (!parse(second, pixel)) return second.getInfoLog();
    glslang::TProgram program;
    program.addShader(&first);
    program.addShader(&second);
    return program.link(EShMsgDefault) ? "" : program.getInfoLog();
}

} // namespace tegument
