#include "tools/emit/effect_json.h"

#include <fmt/format.h>

#include <cstdint>

namespace tegument {

std::string typeName(const Type& type) {
    return type.elements == 0 ? type.name : fmt::format("{}[{}]", type.name, type.elements);
}

Json toJson(const Value& value, const Type& type) {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    const auto& numbers = std::get<std::vector<double>>(value);
    const auto one = [&](double number) -> Json {
        if (type.base == BaseType::Bool) return number != 0;
        if (type.base == BaseType::Int || type.base == BaseType::Uint) return static_cast<std::int64_t>(number);
        return number;
    };
    if (numbers.size() == 1) return one(numbers[0]);
    Json list = Json::array();
    for (const double number : numbers)
        list.push_back(one(number));
    return list;
}

Json toJson(const Annotations& annotations) {
    Json json = Json::object();
    for (const Annotation& annotation : annotations.list)
        json[annotation.name] = toJson(annotation.value, annotation.type);
    return json;
}

Json toJson(const Parameter& parameter) {
    Json json{{"name", parameter.name}, {"type", typeName(parameter.type)}, {"semantic", parameter.semantic}};
    json["default"] = parameter.defaultValue ? toJson(*parameter.defaultValue, parameter.type) : Json(nullptr);
    json["annotations"] = toJson(parameter.annotations);
    return json;
}

} // namespace tegument
