#include "job.h"

#include "com.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>

namespace client {

namespace {

Numbers restAsNumbers(std::istream& line) {
    Numbers numbers;
    for (float number = 0; line >> number;)
        numbers.push_back(number);
    return numbers;
}

std::string restAsText(std::istream& line) {
    std::string text;
    std::getline(line >> std::ws, text);
    return text;
}

std::string objectOf(const std::string& written) {
    return written == "-" ? "" : upper(written);
}

void readTarget(std::istream& line, Job& job) {
    std::string name;
    std::string kind;
    TargetShape shape;
    line >> name >> kind >> shape.width >> shape.height >> shape.format >> shape.levels;
    shape.depth = kind == "depth";
    job.targets[name] = shape;
}

/// What a scene says. False: another kind of statement.
bool readScene(const std::string& key, std::istream& line, Job& job) {
    std::string name;
    std::string object;
    if (key == "picture") {
        line >> job.width >> job.height >> job.background[0] >> job.background[1] >> job.background[2];
    } else if (key == "mesh") {
        line >> job.mesh;
    } else if (key == "scene") {
        line >> name >> object;
        job.scene.push_back({upper(name), objectOf(object), restAsNumbers(line)});
    } else if (key == "value") {
        line >> name;
        job.values[name] = restAsNumbers(line);
    } else if (key == "texture") {
        line >> name >> job.textures[name];
    } else {
        return false;
    }
    return true;
}

/// What an effect file would say.
bool readEffect(const std::string& key, std::istream& line, Job& job) {
    std::string name;
    if (key == "effect") {
        line >> job.effect;
    } else if (key == "technique") {
        line >> job.technique;
    } else if (key == "target") {
        readTarget(line, job);
    } else if (key == "parameter") {
        std::string semantic;
        std::string object;
        line >> name >> semantic >> object;
        job.parameters[name] = {upper(semantic), objectOf(object)};
    } else if (key == "number") {
        line >> name;
        job.numbers[name] = restAsNumbers(line);
    } else if (key == "part") {
        line >> name >> job.parts[name].first >> job.parts[name].count;
    } else if (key == "script") {
        job.script = restAsText(line);
    } else if (key == "sampler") {
        line >> name >> job.samplers[name].filter >> job.samplers[name].address;
    } else if (key == "store") {
        std::string target;
        line >> name >> target;
        job.stores[name] = target == "-" ? "" : target;
    } else {
        return false;
    }
    return true;
}

bool readForeign(const std::string& key, std::istream& line, Job& job) {
    if (key == "foreign") {
        job.foreign = true;
    } else if (key == "sized") {
        line >> job.sized.emplace_back();
    } else if (key == "stream") {
        auto& stream = job.streams.emplace_back();
        line >> stream[0] >> stream[1];
    } else if (key == "step") {
        auto& words = job.steps.emplace_back();
        for (std::string word; line >> word;)
            words.push_back(word);
    } else {
        return false;
    }
    return true;
}

bool readPass(const std::string& key, std::istream& line, Job& job) {
    if (key == "compute") {
        PassInfo& pass = job.passes.emplace_back();
        line >> pass.name >> pass.computeFile >> pass.groups[0] >> pass.groups[1] >> pass.groups[2] >> pass.viewport[0] >> pass.viewport[1];
        return true;
    }
    if (key == "pass") {
        PassInfo& pass = job.passes.emplace_back();
        line >> pass.name >> pass.vertexFile >> pass.pixelFile;
        return true;
    }
    if (job.passes.empty()) return false;
    PassInfo& pass = job.passes.back();
    if (key == "passscript") {
        pass.script = restAsText(line);
        return true;
    }
    if (key == "instances") {
        line >> pass.instances;
        return true;
    }
    if (key != "state") return false;
    std::string name;
    line >> name;
    pass.state[name] = restAsNumbers(line);
    return true;
}

} // namespace

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    return text;
}

std::optional<Numbers> Job::valueOf(const std::string& parameter, const std::string& semantic, const std::string& object,
                                    unsigned columns) const {
    const auto own = values.find(parameter);
    const auto found = std::find_if(scene.begin(), scene.end(), [&](const SceneValue& value) {
        return value.semantic == upper(semantic) && value.object == upper(object);
    });
    if (own == values.end() && found == scene.end()) return std::nullopt;
    Numbers value = own != values.end() ? own->second : found->numbers;
    if (value.size() == 3 && columns == 4) value.push_back(1); // a position's w, a colour's alpha
    return value;
}

IndexRange Job::rangeOf(const std::string& pass, unsigned indices) const {
    const auto part = parts.find(pass);
    return part == parts.end() ? IndexRange{0, indices} : part->second;
}

Numbers Job::emptyColor(const std::string& target) const {
    return target.empty() ? Numbers{background[0], background[1], background[2], 0} : Numbers{0, 0, 0, 0};
}

Job readJob(const std::string& folder, const std::string& file) {
    std::ifstream in(folder + "\\" + file);
    if (!in) fail("cannot read " + folder + "\\" + file);
    Job job;
    job.folder = folder;
    for (std::string text; std::getline(in, text);) {
        std::istringstream line(text);
        std::string key;
        line >> key;
        if (!readScene(key, line, job) && !readEffect(key, line, job) && !readPass(key, line, job) && !readForeign(key, line, job))
            fail("unknown statement '" + key + "' in " + file);
    }
    return job;
}

} // namespace client
