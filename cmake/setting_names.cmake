# The names of the skin's settings as C++ constants, for the rooms that judge the skin. They stand in hlsl/settings.fxh, and nowhere else
# (tests/tools/repository.py): an effect's settings are read from the effect.

set(settings_source ${PROJECT_SOURCE_DIR}/hlsl/settings.fxh)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${settings_source})
file(STRINGS ${settings_source} settings_line REGEX "^#define FX_SETTINGS ")
if(NOT settings_line MATCHES "^#define FX_SETTINGS ([A-Z0-9_]+) ([a-z0-9 ]+)$")
  message(FATAL_ERROR "${settings_source} has no line '#define FX_SETTINGS SWITCH name0 name1 ...'")
endif()
string(REPLACE " " ";" setting_names "${CMAKE_MATCH_2}")
set(setting_switch ${CMAKE_MATCH_1})
set(setting_constants "")
set(setting_list "")
foreach(setting_name IN LISTS setting_names)
  string(SUBSTRING ${setting_name} 0 1 setting_first)
  string(SUBSTRING ${setting_name} 1 -1 setting_rest)
  string(TOUPPER ${setting_first} setting_first)
  set(setting_constant kSetting${setting_first}${setting_rest})
  string(APPEND setting_constants "inline constexpr const char* ${setting_constant} = \"${setting_name}\";\n")
  list(APPEND setting_list ${setting_constant})
endforeach()
list(JOIN setting_list ", " setting_list)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/setting_names.h @ONLY CONTENT
"#pragma once
// Made by cmake/setting_names.cmake from hlsl/settings.fxh.

#include <array>

namespace tegument {

inline constexpr const char* kSettingSwitch = \"@setting_switch@\";
@setting_constants@/// In the order of the switch's values.
inline constexpr std::array kSettingNames = {@setting_list@};

} // namespace tegument
")
