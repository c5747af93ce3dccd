#pragma once
// One effect to run: what an engine would know of its scene. Written by the host (tests/d3d/job_file.cpp), one statement a line:
//
//   effect FILE                            fx_2_0 or fx_4_0; for Direct3D 12 the folder that check --emit has written
//   technique NAME
//   picture WIDTH HEIGHT R G B             the application's targets, and what it clears them to (alpha 0)
//   mesh FILE                              counts, 12 floats a vertex, 32-bit indices
//   part PASS FIRST COUNT                  of the mesh's indices, what a pass draws that names a part of it
//   scene SEMANTIC OBJECT NUMBER...        a value that effects may ask for by semantic; OBJECT - is the camera or the mesh
//   value NAME NUMBER...                   a value that the user has set
//   texture NAME FILE                      levels of a texture, see pixels.h
//   target NAME color|depth WIDTH HEIGHT FORMAT LEVELS
//   parameter NAME SEMANTIC OBJECT         Direct3D 11 only from here on: compiled entry points know no semantics, scripts and states
//   number NAME NUMBER                     what a script reads, where no shader does
//   script TEXT
//   pass NAME VERTEX-FILE PIXEL-FILE
//   compute NAME COMPUTE-FILE X Y Z W H    a pass of so many groups of threads, VIEWPORTPIXELSIZE
//   store NAME TARGET                      what compute shaders write; TARGET - is the picture
//   passscript TEXT                        of the pass before it
//   instances NAME                         likewise: the number that says how often it draws the mesh
//   state KEY NUMBER...                    of the pass before it
//   sampler NAME FILTER ADDRESS
//
// An effect of another host, for Direct3D 9: its frame is a list of steps, and every parameter has its value by name.
//
//   foreign                                passes are numbered; what has no name in the effect is left alone
//   sized NAME                             a parameter that follows the size of what is drawn into
//   stream zero TEXCOORD1                  the same at every vertex: zeros, or a matrix in four streams from this one on
//   stream matrix BLENDWEIGHT0
//   step bind DEPTH COLOUR...              names of targets; - is the application's, . is none
//   step color TARGET R G B A              cleared
//   step depth TARGET DEPTH
//   step stencil TARGET VALUE
//   step copy FROM TO                      all of a target
//   step sample NAME TARGET                a texture parameter reads this target from here on
//   step number NAME VALUE                 what a loop sets
//   step mesh PASS                         draws, by the number of the pass
//   step quad PASS
//   step pixels PASS                       likewise, its corners in pixels

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace client {

using Numbers = std::vector<float>;

struct SceneValue {
    std::string semantic; // upper case
    std::string object;   // empty: camera or mesh
    Numbers numbers;
};

struct TargetShape {
    bool depth = false;
    unsigned width = 0;
    unsigned height = 0;
    std::string format; // D3DFORMAT name
    unsigned levels = 1;
};

struct ParameterInfo {
    std::string semantic;
    std::string object;
};

struct PassInfo {
    std::string name;
    std::string computeFile; // then there is nothing but `groups` and `script`
    std::array<unsigned, 3> groups{};
    std::array<float, 2> viewport{}; // of a compute pass: VIEWPORTPIXELSIZE
    std::string vertexFile;
    std::string pixelFile;
    std::string script;
    std::string instances; // empty: once
    std::map<std::string, Numbers> state;
};

/// Of the mesh's indices.
struct IndexRange {
    unsigned first = 0;
    unsigned count = 0;
};

struct SamplerInfo {
    std::string filter;
    std::string address;
};

struct Job {
    std::string folder; // all files are in it
    std::string effect;
    std::string technique;
    unsigned width = 1;
    unsigned height = 1;
    std::array<float, 3> background{};
    std::string mesh;
    std::map<std::string, IndexRange> parts; // by pass
    std::vector<SceneValue> scene;
    std::map<std::string, Numbers> values;
    std::map<std::string, std::string> textures;
    std::map<std::string, TargetShape> targets;
    std::map<std::string, ParameterInfo> parameters;
    std::map<std::string, Numbers> numbers;
    std::string script;
    std::vector<PassInfo> passes;
    std::map<std::string, SamplerInfo> samplers;
    std::map<std::string, std::string> stores; // the names of targets
    bool foreign = false;
    std::vector<std::string> sized;
    std::vector<std::array<std::string, 2>> streams; // "zero" and the like, name
    std::vector<std::vector<std::string>> steps;     // their words

    [[nodiscard]] std::string path(const std::string& file) const { return folder + "\\" + file; }
    /// A number of the user's, then the scene's; none: the effect's default holds. A position or a colour gets the fourth number that a
    /// vector of four columns asks for.
    [[nodiscard]] std::optional<Numbers> valueOf(const std::string& parameter, const std::string& semantic, const std::string& object,
                                                 unsigned columns) const;
    /// What a pass draws of a mesh of so many indices.
    [[nodiscard]] IndexRange rangeOf(const std::string& pass, unsigned indices) const;
    /// What a colour target holds before the first pass; the application's has the empty name.
    [[nodiscard]] Numbers emptyColor(const std::string& target) const;
};

/// `folder\file`.
Job readJob(const std::string& folder, const std::string& file);

std::string upper(std::string text);

} // namespace client
