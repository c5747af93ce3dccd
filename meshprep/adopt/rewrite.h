#pragma once
// The source of one stage of one pass, from what the effect's author wrote: what the stage reaches, respelt, with samplers as structures of
// picture and state, structures of parameters taken apart, and a flat entry point.

#include "meshprep/adopt/wrapper.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace tegument::adopt {

/// A sampler of Direct3D 9: which picture it reads, under what names both are declared.
struct SamplerPlan {
    std::string kind; // "2D"
    std::string texture;
    std::string state;
};

/// One number or array inside a structure of parameters.
struct LeafPlan {
    std::string name;
    Words type;
    Words array;
};

class Rewriter {
public:
    /// Changes the effect's parameters and samplers to those that the sources declare.
    explicit Rewriter(Effect& effect);

    [[nodiscard]] const Code& code() const { return code_; }
    /// By the author's names; of arrays by "name[0]".
    [[nodiscard]] const std::map<std::string, SamplerPlan>& samplers() const { return samplers_; }
    /// The job of a wrapper for a shader of this effect.
    [[nodiscard]] WrapperJob job(const ShaderReference& shader, bool vertex, std::string name) const;
    [[nodiscard]] Result<Wrapper> wrapped(const WrapperJob& job) const { return wrap(job); }
    /// The whole source around a wrapper of `shader`, or around one that needs nothing.
    [[nodiscard]] std::string source(const ShaderReference* shader, const Wrapper& wrapper) const;
    /// Whether a function, or what it calls, reads a matrix that is a parameter: it places a mesh.
    [[nodiscard]] bool readsMatrix(const ShaderReference& shader) const;

private:
    /// As samplerKind(), also of a SamplerState that tex2D and the like read: with its picture, as theirs are.
    [[nodiscard]] std::optional<std::string> kindOf(const Variable& variable) const;
    [[nodiscard]] static std::vector<std::string> rootsOf(const ShaderReference& shader);
    void planSamplers(Effect& effect);
    void planSampler(Effect& effect, const Variable& variable, const std::string& name);
    std::string textureFor(Effect& effect, const Sampler* sampler, const std::string& name, const std::string& kind,
                           const SourcePosition& at);
    void planLayers(Effect& effect);
    void planStructures(Effect& effect);
    void planLeaves(Effect& effect, const Parameter& whole, const Type& type, const Words& words, const std::string& path,
                    std::size_t& next, std::vector<LeafPlan>& leaves, int depth);
    void planNames(Effect& effect);

    void print(Printer& printer, const Spelling& spelling, std::size_t item, std::set<std::string>& textures) const;
    void printStructure(Printer& printer, const Spelling& spelling, const Structure& structure) const;
    void printVariable(Printer& printer, const Spelling& spelling, const Variable& variable, std::set<std::string>& textures) const;
    void printSampler(Printer& printer, const std::string& name, std::set<std::string>& textures) const;
    void printFunction(Printer& printer, const Spelling& spelling, const Function& function) const;
    [[nodiscard]] Words parameterWords(const Spelling& spelling, const Function& function, std::size_t place) const;
    [[nodiscard]] Words arrayOf(const Variable& variable) const;

    Code code_;
    Uses uses_;
    std::set<std::string> pairs_; // samplers with their pictures
    std::map<std::string, SamplerPlan> samplers_;
    std::map<std::string, std::string> textureKinds_;
    std::map<std::string, std::vector<LeafPlan>> structures_; // by the parameter's name
    std::map<std::string, std::string> renamed_;              // parameters that functions write: their copies
    std::map<std::string, std::string> sizes_;                // parameters that size an array: their values
    std::map<std::string, int> counts_;                       // elements of arrays
    std::map<std::string, std::string> layers_;               // textures of layers or samples: the picture that each of them is
};

} // namespace tegument::adopt
