#include "meshprep/adopt/bind.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

namespace tegument::adopt {

namespace {

using Numbers = std::vector<double>;

constexpr std::size_t kLongestName = 80; // longer ones mean nothing to us

std::string lower(std::string_view text) {
    return toLower(std::string(text.substr(0, kLongestName)));
}

std::string letters(std::string_view text) {
    std::string result;
    for (const char c : text.substr(0, kLongestName))
        if (std::isalpha(static_cast<unsigned char>(c)) != 0) result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

/// Each between blanks.
constexpr std::string_view kBases =
    " WORLD=WORLD MODEL=WORLD OBJECT=WORLD LOCAL=WORLD OBJECTTOWORLD=WORLD OBJTOWORLD=WORLD MODELTOWORLD=WORLD LOCALTOWORLD=WORLD "
    "VIEW=VIEW CAMERA=VIEW WORLDTOVIEW=VIEW WORLDTOCAMERA=VIEW PROJECTION=PROJECTION PROJ=PROJECTION VIEWTOPROJECTION=PROJECTION "
    "WORLDVIEW=WORLDVIEW MODELVIEW=WORLDVIEW OBJECTTOVIEW=WORLDVIEW WV=WORLDVIEW VIEWPROJECTION=VIEWPROJECTION VIEWPROJ=VIEWPROJECTION "
    "WORLDTOPROJECTION=VIEWPROJECTION WORLDTOCLIP=VIEWPROJECTION VP=VIEWPROJECTION WORLDVIEWPROJECTION=WORLDVIEWPROJECTION "
    "WORLDVIEWPROJ=WORLDVIEWPROJECTION MODELVIEWPROJECTION=WORLDVIEWPROJECTION MODELVIEWPROJ=WORLDVIEWPROJECTION "
    "WORLDPROJECTION=WORLDVIEWPROJECTION OBJECTTOPROJECTION=WORLDVIEWPROJECTION OBJECTTOCLIP=WORLDVIEWPROJECTION "
    "FINAL=WORLDVIEWPROJECTION WVP=WORLDVIEWPROJECTION MVP=WORLDVIEWPROJECTION ";

struct Form {
    std::string_view text;
    std::string_view suffix;
};
/// The longest first.
constexpr std::array<Form, 13> kForms{{{"INVERSETRANSPOSE", "INVERSETRANSPOSE"},
                                       {"TRANSPOSEINVERSE", "INVERSETRANSPOSE"},
                                       {"INVTRANSPOSE", "INVERSETRANSPOSE"},
                                       {"TRANSPOSEINV", "INVERSETRANSPOSE"},
                                       {"INVTRANS", "INVERSETRANSPOSE"},
                                       {"INVERSE", "INVERSE"},
                                       {"TRANSPOSE", "TRANSPOSE"},
                                       {"TRANS", "TRANSPOSE"},
                                       {"INV", "INVERSE"},
                                       {"IT", "INVERSETRANSPOSE"},
                                       {"TI", "INVERSETRANSPOSE"},
                                       {"I", "INVERSE"},
                                       {"T", "TRANSPOSE"}}};

std::optional<std::string> base(std::string_view text) {
    const std::string key = fmt::format(" {}=", text);
    const std::size_t at = kBases.find(key);
    if (at == std::string_view::npos) return std::nullopt;
    const std::string_view rest = kBases.substr(at + key.size());
    return std::string(rest.substr(0, rest.find(' ')));
}

/// g_mWorld, matView, m_ViewProj: the name without its author's prefixes, the whole name first.
std::vector<std::string> cores(std::string_view name) {
    std::vector<std::string> list;
    std::string text(name.substr(0, kLongestName));
    for (const std::string_view prefix : {"g_", "m_", "gs_", "c_", "u_", "k_"})
        if (text.starts_with(prefix)) {
            text.erase(0, prefix.size());
            break;
        }
    list.push_back(text);
    for (int i = 0; i < 2; ++i)
        for (const std::string_view prefix :
             {"matrix", "mat", "mtx", "mx", "the", "cur", "fv", "g", "m", "v", "f", "c", "n", "i", "b", "p", "x"})
            if (text.starts_with(prefix) && text.size() > prefix.size() + 1 &&
                (std::isupper(static_cast<unsigned char>(text[prefix.size()])) != 0 || text[prefix.size()] == '_')) {
                text.erase(0, prefix.size());
                text.erase(0, text.find_first_not_of('_'));
                list.push_back(text);
                break;
            }
    return list;
}

bool isZero(const Parameter& parameter) {
    const auto* numbers = parameter.defaultValue ? std::get_if<Numbers>(&*parameter.defaultValue) : nullptr;
    return !numbers || std::ranges::all_of(*numbers, [](double n) { return n == 0; });
}

bool isMatrix(const Type& type) {
    return type.rows > 1;
}

bool isVector(const Type& type, int least) {
    return type.rows == 1 && type.columns >= least && type.elements == 0;
}

/// One number for each place of the type.
Numbers filled(const Type& type, const Numbers& value) {
    const auto count = static_cast<std::size_t>(type.scalarCount());
    const auto columns = static_cast<std::size_t>(type.columns);
    if (value.size() == count) return value;
    Numbers numbers(count);
    for (std::size_t i = 0; i < count; ++i)
        numbers[i] = value[std::min(i % columns, value.size() - 1)];
    return numbers;
}

Numbers identity(const Type& type) {
    Numbers numbers(static_cast<std::size_t>(type.scalarCount()));
    const auto columns = static_cast<std::size_t>(type.columns);
    const std::size_t one = static_cast<std::size_t>(type.rows) * columns;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        numbers[i] = (i % one) / columns == (i % one) % columns ? 1 : 0;
    return numbers;
}

bool holds(const std::string& text, std::initializer_list<std::string_view> parts) {
    return std::ranges::any_of(parts, [&](std::string_view part) { return text.find(part) != std::string::npos; });
}

/// What a value means. `Semantic`: host/run gives it.
struct Meaning {
    std::string semantic; // of host/run; empty: `value`
    std::string object;
    Numbers value;
    std::string words; // for the report
};

Meaning semantic(std::string name, std::string object = {}) {
    std::string words = name + (object.empty() ? "" : " of the light");
    return {.semantic = std::move(name), .object = std::move(object), .words = std::move(words)};
}

Meaning constant(Numbers value, std::string words) {
    return {.value = std::move(value), .words = std::move(words)};
}

class Binder {
public:
    Binder(Parameter& parameter, const AdoptOptions& options, int sign) : parameter_(parameter), options_(options), sign_(sign) {}

    ParameterBinding run() {
        if (const auto asked = options_.bind.find(parameter_.name); asked != options_.bind.end()) return byRule(asked->second);
        if (const auto address = parameter_.annotations.string("SasBindAddress"))
            if (const auto meaning = ofAddress(lower(*address))) return apply(*meaning, "SasBindAddress");
        if (!parameter_.semantic.empty()) {
            if (equalsIgnoreCase(parameter_.semantic, "CONTROLOBJECT")) return neutral("CONTROLOBJECT, at rest");
            if (const auto meaning = ofSemantic(letters(parameter_.semantic))) return apply(*meaning, "semantic " + parameter_.semantic);
        }
        if (const auto meaning = ofObject()) return apply(*meaning, "Object");
        for (const std::string& core : cores(parameter_.name))
            if (const auto meaning = ofName(core)) return apply(*meaning, "name");
        if (equalsIgnoreCase(parameter_.annotations.string("UIWidget").value_or(""), "color"))
            return apply(constant({1, 1, 1, 1}, "white"), "UIWidget");
        return neutral("nothing known");
    }

private:
    ParameterBinding report(std::string source, std::string rule) {
        return {.parameter = parameter_.name, .source = std::move(source), .rule = std::move(rule)};
    }

    ParameterBinding byRule(const std::string& rule) {
        if (equalsIgnoreCase(rule, "default") || equalsIgnoreCase(rule, "zero")) {
            if (equalsIgnoreCase(rule, "zero")) parameter_.defaultValue = filled(parameter_.type, {0});
            return neutral("--bind");
        }
        const auto meaning = ofSemantic(letters(rule));
        if (!meaning) return neutral(fmt::format("--bind names no value of this host: '{}'", rule));
        return apply(*meaning, "--bind");
    }

    /// A value that the author gave stays; one that only the scene knows does not.
    ParameterBinding apply(const Meaning& meaning, const std::string& rule) {
        if (!meaning.semantic.empty()) {
            clearSemantic();
            parameter_.semantic = meaning.semantic;
            if (!meaning.object.empty())
                parameter_.annotations.list.push_back(
                    {"Object", {.base = BaseType::String, .name = "string"}, meaning.object, parameter_.at, {}});
            return report(meaning.words, rule);
        }
        if (!isZero(parameter_)) return neutral(rule);
        clearSemantic();
        parameter_.defaultValue = isMatrix(parameter_.type) ? identity(parameter_.type) : filled(parameter_.type, meaning.value);
        return report(meaning.words, rule);
    }

    ParameterBinding neutral(const std::string& rule) {
        clearSemantic();
        if (!isZero(parameter_)) return report("its default", rule);
        if (isMatrix(parameter_.type)) {
            parameter_.defaultValue = identity(parameter_.type);
            return report("the identity", rule);
        }
        parameter_.defaultValue = filled(parameter_.type, {0});
        return report("zero", rule);
    }

    void clearSemantic() {
        parameter_.semantic.clear();
        std::erase_if(parameter_.annotations.list, [](const Annotation& a) { return equalsIgnoreCase(a.name, "Object"); });
    }

    [[nodiscard]] bool isFloat() const { return parameter_.type.base == BaseType::Float; }

    [[nodiscard]] std::optional<Meaning> matrix(std::string_view text) const {
        if (!isFloat() || !isMatrix(parameter_.type) || parameter_.type.rows < 3 || parameter_.type.columns < 3) return std::nullopt;
        const auto name = matrixName(text);
        if (!name) return std::nullopt;
        if (parameter_.type.elements > 0) return constant({0}, "identities: no bones");
        return semantic(*name);
    }

    /// Several lights: a key light from above left, a fill light from the right, a rim light from behind.
    [[nodiscard]] std::optional<Meaning> lights(double length, double sign) const {
        if (!isFloat() || isMatrix(parameter_.type) || parameter_.type.columns < 3 || parameter_.type.elements == 0) return std::nullopt;
        constexpr std::array<std::array<double, 3>, 3> kDirections{{{-0.27, 0.53, 0.8}, {0.8, 0.2, 0.56}, {0.1, 0.6, -0.79}}};
        Numbers numbers;
        for (int i = 0; i < parameter_.type.elements; ++i)
            for (int c = 0; c < parameter_.type.columns; ++c)
                numbers.push_back(c == 3 ? (length > 1 ? 1 : 0)
                                         : kDirections[static_cast<std::size_t>(i) % kDirections.size()][static_cast<std::size_t>(c)] *
                                               length * sign);
        return constant(std::move(numbers), length > 1 ? "places of key, fill and rim light" : "key, fill and rim light");
    }

    [[nodiscard]] std::optional<Meaning> position(bool light) const {
        constexpr double kAway = 7.5; // radii of the mesh, as far as the usual light
        if (light && parameter_.type.elements > 0) return lights(kAway, 1);
        if (!isFloat() || !isVector(parameter_.type, 3)) return std::nullopt;
        return light ? semantic("POSITION", "PointLight0") : semantic("CAMERAPOSITION");
    }

    /// What the code does with it tells. Where it does not: DXSAS's DIRECTION is the one in which light goes, others lead to it.
    [[nodiscard]] std::optional<Meaning> lightDirection(bool travels) const {
        if (sign_ != 0) travels = sign_ < 0;
        if (parameter_.type.elements > 0) return lights(1, travels ? -1 : 1);
        if (!isFloat() || !isVector(parameter_.type, 3)) return std::nullopt;
        return semantic(travels ? "LIGHTDIRECTION" : "TOLIGHT");
    }

    [[nodiscard]] std::optional<Meaning> ofAddress(const std::string& address) const {
        if (holds(address, {"jointtoworld", "skeleton"})) return matrix("WORLD");
        if (holds(address, {"camera.worldtoview"})) return matrix("VIEW");
        if (holds(address, {"camera.projection"})) return matrix("PROJECTION");
        if (holds(address, {"camera.position"})) return position(false);
        if (holds(address, {"light"}) && address.ends_with("position")) return position(true);
        if (address.ends_with("direction")) return lightDirection(true);
        if (holds(address, {"numpointlights", "numdirectionallights"})) return constant({1}, "one");
        if (holds(address, {"numspotlights"})) return constant({0}, "none");
        if (holds(address, {"color", "ambient"})) return constant({1, 1, 1, 1}, "white");
        if (holds(address, {"time"})) return constant({1}, "one second");
        return std::nullopt;
    }

    [[nodiscard]] bool ofLight() const {
        const std::string object = lower(parameter_.annotations.string("Object").value_or(""));
        return holds(object, {"light", "lamp"});
    }

    [[nodiscard]] std::optional<Meaning> ofObject() const {
        const std::string object = lower(parameter_.annotations.string("Object").value_or(""));
        if (holds(object, {"camera"}) && isVector(parameter_.type, 3)) return position(false);
        if (!ofLight()) return std::nullopt;
        if (holds(lower(parameter_.name), {"dir"}) || holds(object, {"direction"})) return lightDirection(true);
        if (holds(lower(parameter_.name), {"col", "diffuse", "intensity"})) return constant({1, 1, 1, 1}, "white");
        return position(true);
    }

    [[nodiscard]] std::optional<Meaning> viewport(const std::string& text) const {
        const double width = options_.width;
        const double height = options_.height;
        const bool inverse = holds(text, {"INV", "RCP", "TEXEL", "ONEOVER"});
        const bool half = holds(text, {"HALF"});
        const auto side = [&](double length) { return (inverse || half ? 1 / length : length) * (half ? 0.5 : 1); };
        if (!isFloat() || isMatrix(parameter_.type) || parameter_.type.elements > 0) return std::nullopt;
        if (holds(text, {"RATIO", "ASPECT"})) return constant({width / height}, "the picture's width by height");
        if (isVector(parameter_.type, 2)) {
            if (!inverse && !half && parameter_.type.columns == 2) return semantic("VIEWPORTPIXELSIZE");
            return constant({side(width), side(height), inverse || half ? width : 1 / width, inverse || half ? height : 1 / height},
                            "the picture's size");
        }
        return constant({side(holds(text, {"HEIGHT"}) ? height : width)}, "the picture's size");
    }

    [[nodiscard]] std::optional<Meaning> colour(const std::string& text) const {
        if (!isFloat() || isMatrix(parameter_.type)) return std::nullopt;
        const bool one = parameter_.type.columns == 1;
        if (one && holds(text, {"POWER", "SHIN", "EXP", "GLOSS"})) return constant({20}, "20");
        if (holds(text, {"AMBI"})) return constant({0.2, 0.2, 0.2, 1}, "a dark grey");
        if (holds(text, {"SPEC"})) return constant({0.5, 0.5, 0.5, 1}, "grey");
        if (holds(text, {"EMISS"})) return constant({0, 0, 0, 1}, "black");
        return constant({1, 1, 1, 1}, one ? "one" : "white");
    }

    [[nodiscard]] std::optional<Meaning> bounds(const std::string& text) const {
        for (const std::string_view name : {"BOUNDINGCENTER", "BOUNDINGBOXMIN", "BOUNDINGBOXMAX", "BOUNDINGBOXSIZE"})
            if (text == name && isFloat() && isVector(parameter_.type, 3)) return semantic(std::string(name));
        if (holds(text, {"BOUNDINGSPHERE"}) && isFloat() && parameter_.type.scalarCount() == 1) return semantic("BOUNDINGSPHERESIZE");
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Meaning> scalar(const std::string& text) const {
        if (!isFloat() || parameter_.type.scalarCount() != 1) return std::nullopt;
        if (text == "NEARCLIP" || text == "NEARPLANE" || text == "CAMERANEAR" || text == "NEAR") return semantic("NEARCLIP");
        if (text == "FARCLIP" || text == "FARPLANE" || text == "CAMERAFAR" || text == "FAR") return semantic("FARCLIP");
        if (text == "FIELDOFVIEW" || text == "FOV") return semantic("FIELDOFVIEW");
        if (text == "RANDOM") return constant({0.5}, "0.5");
        if (text == "UNITSSCALE") return constant({1}, "one");
        return std::nullopt;
    }

    /// Upper case letters of the semantic, without its index.
    [[nodiscard]] std::optional<Meaning> ofSemantic(const std::string& text) const {
        if (auto found = matrix(text)) return found;
        if (isMatrix(parameter_.type)) return std::nullopt;
        if (text == "LIGHTENABLE" || text == "LIGHTENABLED") return constant({1}, "on");
        if (text == "POSITION") return position(ofLight());
        if (holds(text, {"LIGHT"}) && holds(text, {"COL", "DIFFUSE", "SPECULAR", "AMBIENT", "INTENSITY"})) return colour(text);
        if (holds(text, {"LIGHTPOS"}) || (text.starts_with("LIGHT") && text.ends_with("POSITION"))) return position(true);
        if (holds(text, {"CAMERAPOS", "VIEWPOS", "EYEPOS", "EYELOC", "CAMERALOC", "EYEPOINT"})) return position(false);
        if (text == "DIRECTION") return ofLight() ? lightDirection(true) : directionOfCamera();
        if (holds(text, {"LIGHTDIR"})) return lightDirection(true);
        if (text == "TOLIGHT") return lightDirection(false);
        if (holds(text, {"CAMERADIRECTION", "VIEWDIRECTION"})) return directionOfCamera();
        if (holds(text, {"VIEWPORT", "SCREENSIZE", "PIXELSIZE", "RENDERTARGETDIMENSIONS"})) return viewport(text);
        if (auto found = bounds(text)) return found;
        if (auto found = scalar(text)) return found;
        if (holds(text, {"TIME", "FRAMECOUNT"})) return constant({1}, "one second");
        if (holds(text, {"FOG"})) return fog(lower(text));
        if (holds(text, {"MOUSE"})) return constant({0}, "zero");
        if (holds(text, {"BONE", "JOINT", "WORLDMATRIXARRAY"})) return constant({0}, "identities: no bones");
        if (holds(text,
                  {"DIFFUSE", "SPECULAR", "AMBIENT", "EMISSIVE", "POWER", "SHININESS", "OPACITY", "ALPHA", "COLOR", "COLOUR", "INTENSITY"}))
            return colour(text);
        return std::nullopt;
    }

    /// None: it begins behind everything. Zero for where it begins and ends would be fog from the eye on.
    [[nodiscard]] Meaning fog(const std::string& name) const {
        constexpr double kFar = 100'000; // radii of the mesh
        const bool one = isFloat() && parameter_.type.scalarCount() == 1;
        if (!one || parameter_.defaultValue || holds(name, {"blend"})) return constant({0}, "zero: no fog"); // an author's zero is meant
        if (holds(name, {"end", "far", "max"})) return constant({2 * kFar}, "behind everything: no fog");
        if (holds(name, {"start", "begin", "near", "min", "range", "dist"})) return constant({kFar}, "behind everything: no fog");
        return constant({0}, "zero: no fog");
    }

    [[nodiscard]] std::optional<Meaning> directionOfCamera() const {
        if (!isFloat() || !isVector(parameter_.type, 3)) return std::nullopt;
        return semantic("CAMERADIRECTION");
    }

    [[nodiscard]] std::optional<Meaning> ofName(const std::string& core) const {
        const std::string text = letters(core);
        const std::string name = lower(core);
        if (isMatrix(parameter_.type)) {
            if (auto found = matrix(text)) return found;
            if (holds(name, {"bone", "skin", "palette", "joint", "blend"})) return constant({0}, "identities: no bones");
            return std::nullopt;
        }
        const bool light = holds(name, {"light", "lamp", "sun", "lhtdir"}); // the last: a sample of an old SDK
        if (light && parameter_.type.base == BaseType::Bool && holds(name, {"enable", "active"})) return constant({1}, "on");
        if (holds(name, {"eye", "camera", "viewer", "cam"}) || text == "VIEWPOSITION" || text == "VIEWPOS") {
            if (holds(name, {"dir", "forward", "look"})) return directionOfCamera();
            if (holds(name, {"pos", "point", "location"}) || name.ends_with("pt") || text == "EYE" || text == "CAMERA")
                return position(false);
        }
        const bool coloured = holds(name, {"col", "diffuse", "specular", "ambient", "intensity"}); // DirLight0DiffuseColor
        if (light && !coloured && holds(name, {"dir", "vec", "normal"})) return lightDirection(false);
        if (light && (holds(name, {"pos", "location"}) || text == "LIGHT" || text == "LAMP")) return position(true);
        const bool r = text == "R" && parameter_.type.columns == 2; // vvvv's effects of textures
        if (r || holds(name, {"viewport", "screen", "resolution", "pixelsize", "texelsize", "halfpixel", "rendertargetsize", "aspect"}))
            return viewport(text);
        if (auto found = scalar(text)) return found;
        if (name == "time" || name.ends_with("time") || holds(name, {"time0_", "elapsed", "timer"})) return constant({1}, "one second");
        if (holds(name, {"fog"})) return fog(name);
        if (holds(name, {"bone"})) return constant({0}, "zero");
        if (holds(name, {"tiling", "tile", "uvscale", "texscale"})) return constant({1}, "one");
        if (light || holds(name, {"diffuse", "specular", "ambient", "emissive", "shininess", "opacity", "alpha", "albedo", "colo",
                                  "material", "power", "intensity"}))
            return colour(text);
        return factor(name);
    }

    /// What everything is multiplied with: zero would be black. An author's zero is meant.
    [[nodiscard]] std::optional<Meaning> factor(const std::string& name) const {
        if (!isFloat() || isMatrix(parameter_.type) || parameter_.defaultValue) return std::nullopt;
        if (holds(name, {"weight"})) {
            const int count = std::max(parameter_.type.elements, 1);
            return constant({1.0 / count}, count > 1 ? "one, shared out" : "one");
        }
        if (holds(name, {"scale", "factor", "tone", "gain", "exposure", "multipl"})) return constant({1, 1, 1, 1}, "one");
        return std::nullopt;
    }

    Parameter& parameter_;
    const AdoptOptions& options_;
    int sign_;
};

} // namespace

std::optional<std::string> matrixName(std::string_view name) {
    std::string text = letters(name);
    if (const std::size_t at = text.find("PRJ"); at != std::string::npos) text.replace(at, 3, "PROJ");
    for (const std::string_view end : {"MATRIX", "MTX", "XFORM", "TRANSFORM", "TM", "MAT"})
        if (text.ends_with(end) && text.size() > end.size()) {
            text.resize(text.size() - end.size());
            break;
        }
    for (const std::string_view begin : {"MATRIX", "MTX", "MAT"})
        if (text.starts_with(begin) && text.size() > begin.size()) {
            text.erase(0, begin.size());
            break;
        }
    if (const auto plain = base(text)) return plain;
    for (const Form& form : kForms) {
        if (text.ends_with(form.text))
            if (const auto found = base(std::string_view(text).substr(0, text.size() - form.text.size())))
                return *found + std::string(form.suffix);
        if (text.starts_with(form.text))
            if (const auto found = base(std::string_view(text).substr(form.text.size()))) return *found + std::string(form.suffix);
    }
    return std::nullopt;
}

ParameterBinding bindParameter(Parameter& parameter, const AdoptOptions& options, int sign) {
    return Binder(parameter, options, sign).run();
}

bool isTargetSize(std::string_view name, std::string_view semantic) {
    const std::string both = lower(name) + " " + lower(semantic);
    return holds(both, {"viewport", "screen", "resolution", "pixelsize", "texelsize", "targetsize", "targetdimensions", "backbuffer"});
}

std::string textureStandIn(const Parameter& parameter) {
    const std::string name =
        lower(parameter.name + " " + parameter.semantic + " " + parameter.annotations.string("ResourceName").value_or(""));
    const std::string function = lower(parameter.annotations.string("Function").value_or(""));
    if (parameter.type.base == BaseType::TextureCube) return holds(name + " " + function, {"norm"}) ? "normals" : "sky";
    if (holds(name, {"norm", "bump", "nrm"})) return "normal";
    if (holds(name, {"noise", "rand"})) return "noise";
    if (holds(name, {"ramp", "lut", "toon", "grad", "curve", "falloff", "lookup"}) || parameter.type.name == "texture1D") return "ramp";
    if (holds(name, {"spec", "mask", "gloss", "light", "shad", "occl", "white"})) return "white";
    if (holds(name, {"env", "sky", "refl"})) return "grey";
    return "checker";
}

} // namespace tegument::adopt
