// What a parameter may be bound to, for whoever chooses from a list.

#include "meshprep/adopt/adopt.h"

namespace tegument {

namespace {

std::vector<std::string> matrixChoices() {
    std::vector<std::string> names;
    for (const char* matrix : {"WORLDVIEWPROJECTION", "WORLD", "VIEW", "PROJECTION", "WORLDVIEW", "VIEWPROJECTION"})
        for (const char* form : {"", "INVERSE", "TRANSPOSE", "INVERSETRANSPOSE"})
            names.push_back(std::string(matrix) + form);
    return names;
}

std::vector<std::string> numberChoices(const Type& type) {
    const bool floats = type.base == BaseType::Float;
    if (floats && type.rows >= 3 && type.columns >= 3 && type.elements == 0) return matrixChoices();
    if (floats && type.rows == 1 && type.elements == 0 && type.columns >= 3)
        return {"CAMERAPOSITION", "CAMERADIRECTION", "LIGHTPOSITION", "LIGHTDIRECTION", "TOLIGHT", "COLOR"};
    if (floats && type.rows == 1 && type.elements == 0 && type.columns == 2) return {"VIEWPORTPIXELSIZE"};
    if (floats && type.rows == 1 && type.elements == 0 && type.columns == 1) return {"TIME", "NEARCLIP", "FARCLIP", "FIELDOFVIEW"};
    return {};
}

} // namespace

std::vector<std::string> bindChoices(const Parameter& parameter) {
    const Type& type = parameter.type;
    if (type.isTexture()) {
        if (type.base == BaseType::TextureCube) return {"sky", "normals"};
        return {"checker", "white", "grey", "normal", "ramp", "noise"};
    }
    if (!type.isNumeric()) return {};
    std::vector<std::string> names = numberChoices(type);
    names.insert(names.end(), {"default", "zero"});
    return names;
}

} // namespace tegument
