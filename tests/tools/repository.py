#!/usr/bin/env python3
"""Rules that hold for the repository as a whole: `repository.py CHECK [ROOT]`, or `repository.py --list`.

A check is a function that yields findings, one line each. Exit code 0: none, 1: some, 77: the check cannot run here (ctest: skipped).
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

import diagnostics
import rooms

SKIPPED = 77
SOURCES = {".cpp", ".h", ".fx", ".fxh"}
PROSE = {".md"}
SCRIPTS = {".py", ".sh", ".cmake", ".txt", ".json", ".yml", ""}
OUTSIDE = {"build", "out", "__pycache__"}
MAX_SHADER_COLUMNS = 140
MAX_README_LINES = 30
MAX_USER_PAGES = 25
MAX_USER_WORDS = 40000
MAX_FRONT_LINES = 50


class Skip(Exception):
    """The check needs something that this machine lacks."""


def files(root, suffixes):
    """Paths of the repository's files with one of these endings, in a fixed order."""
    found = []
    for path in sorted(root.iterdir()) if root.is_dir() else []:
        if path.name in OUTSIDE or (path.is_dir() and path.name[0] == "." and path.name != ".ci"):
            continue
        if path.is_dir():
            found += files(path, suffixes)
        elif path.suffix in suffixes:
            found.append(path)
    return found


def text_of(path):
    return path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""


def lines_with(root, suffixes, pattern):
    """(path, line number, match) of every match."""
    for path in files(root, suffixes):
        for number, line in enumerate(text_of(path).splitlines(), 1):
            for match in re.finditer(pattern, line):
                yield path, number, match


def without_comments(code):
    """C++ or HLSL with comments blanked out, lines and strings kept."""
    pattern = r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*.*?\*/'
    return re.sub(pattern, lambda m: m[0] if m[0][0] in "\"'" else re.sub(r"[^\n]", " ", m[0]), code, flags=re.S)


def shaders_have_lines_of_at_most_140_characters(root):
    for path in files(root / "hlsl", SOURCES) + files(root / "effects", SOURCES):
        for number, line in enumerate(text_of(path).splitlines(), 1):
            if len(line) > MAX_SHADER_COLUMNS:
                yield f"{path}:{number}: {len(line)} characters"


def no_file_names_a_registry_host_or_a_path_of_one_machine(root):
    hosts = r"\b(?:[\w-]+\.)*(?:pypi|pythonhosted|debian|npmjs|crates|maven|anaconda|nuget)\.(?:org|io|com)\b"
    paths = r"(?<![\w.])/(?:root|home|Users)/[\w.-]+"
    for path, number, match in lines_with(root, SOURCES | PROSE | SCRIPTS, f"{hosts}|{paths}"):
        yield f"{path}:{number}: {match[0]}"


def nothing_is_left_unfinished(root):
    marks = "|".join(["TO" + "DO", "FIX" + "ME", "XX" + "X", "HA" + "CK"])
    for path, number, match in lines_with(root, SOURCES | PROSE | SCRIPTS, rf"\b(?:{marks})\b"):
        yield f"{path}:{number}: {match[0]}"


def every_test_that_the_conventions_name_exists(root):
    page = root / "docs" / "conventions.md"
    tests = "\n".join(text_of(path) for path in files(root / "tests", {".cpp"}))
    defined = set(re.findall(r"^TEST(?:_[FP])?\((\w+),\s*(\w+)\)", tests, flags=re.M))
    for number, line in enumerate(text_of(page).splitlines(), 1):
        for suite, name in re.findall(r"`([A-Z]\w+)\.(\w+)`", line):
            if (suite, name) not in defined:
                yield f"{page}:{number}: no test {suite}.{name}"


def the_page_of_diagnostics_is_made_from_its_table(root):
    if diagnostics.outdated(root):
        yield f"{diagnostics.PAGE}: python3 tests/tools/diagnostics.py --write"


def program_code(root):
    for folder in rooms.TOPS:
        for path in files(root / folder, {".cpp", ".h"}):
            yield path, without_comments(text_of(path))


def every_diagnostic_code_is_documented(root):
    documented = [row["code"] for row in diagnostics.codes(root)]
    yield from (f"{diagnostics.TABLE}: TG{code} again" for code in sorted({code for code in documented if documented.count(code) > 1}))
    raised = r"\b\w*(?:[Ee]rror|[Ww]arning|[Ww]arn|[Nn]ote|[Ff]ail|[Dd]iagnose)\w*\(\s*([1-8]\d{3})\b|\bcode\s*=\s*([1-8]\d{3})\b|\bTG(\d{4})\b"
    for path, code in program_code(root):
        for match in re.finditer(raised, code):
            number = int(next(group for group in match.groups() if group))
            if number not in documented:
                yield f"{path}:{code.count(chr(10), 0, match.start()) + 1}: TG{number} is not in {diagnostics.TABLE}"


def named_codes(code):
    """Numbers that stand alone, or behind TG."""
    return {int(number) for number in re.findall(r"(?<![\w.])(?:TG)?([1-8]\d{3})(?![\w.])", code)}


def every_documented_code_can_be_raised(root):
    literals = set().union(*(named_codes(code) for _, code in program_code(root)))
    for row in diagnostics.codes(root):
        if row["code"] not in literals:
            yield f"{diagnostics.TABLE}: no source raises TG{row['code']}"


def every_diagnostic_code_is_tested(root):
    """A test names it, in code or as the name of a file, or the table says why none can."""
    tested = set()
    for path in files(root / "tests", SOURCES | {".py", ".cmake"}):
        if path.parts[1] != "tools":
            tested |= named_codes(text_of(path)) | {int(number) for number in re.findall(r"^(\d{4})_", path.name)}
    for row in diagnostics.codes(root):
        if (row["code"] in tested) == bool(row.get("untested")):
            yield f"{diagnostics.TABLE}: TG{row['code']} " + ("is tested, yet has a reason why not" if row.get("untested") else "has no test")


def rooms_include_each_other_without_a_cycle(root):
    includes = rooms.includes(root)
    _, cyclic = rooms.ordered(includes)
    for room in cyclic:
        yield f"{room}: includes, among others in a cycle or above one, {', '.join(sorted(includes[room] & set(cyclic)))}"


def data_goes_down_from_folder_to_folder(root):
    """host knows nothing above it, meshprep only host, tools all but lab: the program reaches the laboratory by one function."""
    above = {"host": ("meshprep", "tools", "lab", "tests"), "meshprep": ("tools", "lab", "tests"), "tools": ("lab", "tests"), "lab": ("tests",)}
    for folder, unknown in above.items():
        for path in files(root / folder, {".cpp", ".h"}):
            for number, line in enumerate(text_of(path).splitlines(), 1):
                if re.match(rf'#include "(?:{"|".join(unknown)})/', line):
                    yield f"{path}:{number}: {line}"


def the_host_serves_every_effect_alike(root):
    """No name, annotation or text in host is of one family of effects: strands and their passes belong to meshprep/assets."""
    words = r"\b\w*(?:[Ss]trand|[Rr]ibbon|[Uu]nderfur|[Ff]ur(?![tn])|[Hh]air)\w*"
    for path in files(root / "host", {".cpp", ".h"}):
        for number, line in enumerate(without_comments(text_of(path)).splitlines(), 1):
            for match in re.finditer(words, line):
                yield f"{path}:{number}: {match[0]}"
    known = set(re.findall(r'\{"(\w+)", k(?:Text|Number)', text_of(root / "host" / "effect" / "load.cpp")))
    families = {}
    for path in files(root / "effects", SOURCES):
        for name in re.findall(r"\b(?:string|float\d?|int|bool) (\w+) =", text_of(path)):
            families.setdefault(name, set()).add("strands" if re.search(r"fur|hair", path.name, re.I) else "others")
    general = {"Part", "Viewport"}  # a submesh; the size that a compute pass is for
    for name in sorted(known - general):
        if families.get(name) == {"strands"}:
            yield f"host/effect/load.cpp: the annotation {name} is of effects that draw strands alone"


def some_libraries_are_known_to_one_room(root):
    """What stands behind a wrapper of ours, or serves one subcommand, is included there alone: other rooms build without it."""
    homes = {"embree3": "meshprep/rays", "embree4": "meshprep/rays", "opensubdiv": "meshprep/human", "tbb": "host/support", "ft2build": "tools/cli", "webp": "tools/cli", "GLFW": "tools/view"}
    for path in [path for folder in rooms.TOPS for path in files(root / folder, {".cpp", ".h"})]:
        for library in re.findall(r"^#include <(\w+)[./]", text_of(path), re.MULTILINE):
            if library in homes and path.relative_to(root).parent.as_posix() != homes[library]:
                yield f"{path}: includes {library}, which is for {homes[library]}"


def public_headers(root):
    listed = re.search(r"set\(public_headers\s+([^)]*)\)", text_of(root / "cmake" / "install.cmake"))
    return listed[1].split() if listed else []


def public_headers_are_meant_for_users(root):
    """What is installed says what it is for, is no room's own, and includes nothing that is not installed."""
    listed = public_headers(root)
    for name in listed:
        text = text_of(root / name)
        if not re.match(r"#pragma once\n// \S", text) or re.search(r"\b[Ii]nside (?:host|this room)\b", text):
            yield f"{name}: is installed, yet does not say what a user has of it"
        for other in re.findall(r'^#include "([^"]+)"', text, re.MULTILINE):
            if other not in listed:
                yield f"{name}: is installed and includes {other}, which is not"


def the_changelog_knows_the_version_that_is_built(root):
    """Its newest release is the project's version; nothing can be broken for users before there are any: not in the oldest."""
    page = text_of(root / "CHANGELOG.md")
    versions = re.findall(r"^## \[(\d[^\]]*)\] - \d{4}-\d\d-\d\d$", page, re.MULTILINE)
    built = re.search(r"^project\(\w+ VERSION ([\d.]+)", text_of(root / "CMakeLists.txt"), re.MULTILINE)
    if built and built[1] not in versions[:1]:
        yield f"CHANGELOG.md: its newest release is {', '.join(versions[:1]) or 'none'}, CMakeLists.txt builds {built[1]}"
    if versions and "**Breaking**" in page[page.index(f"## [{versions[-1]}]") :]:
        yield f"CHANGELOG.md: something is **Breaking** in {versions[-1]}, the first release"


def cpp_files_are_formatted(root):
    if not shutil.which("clang-format"):
        raise Skip("clang-format is not installed")
    version = subprocess.run(["clang-format", "--version"], capture_output=True, text=True, check=True).stdout
    if " 14." not in version:
        raise Skip("versions of clang-format differ in details; the files follow version 14, this is " + version.strip())
    command = ["clang-format", "--dry-run", "-Werror", *map(str, files(root, {".cpp", ".h"}))]
    messages = subprocess.run(command, capture_output=True, text=True, check=False).stderr
    yield from (line for line in messages.splitlines() if " error: " in line)


def tests_are_registered_where_no_failure_is_lost(root):
    """cmake/tests.cmake decides by exit codes; what else ctest offers takes a failure for a skip, or a case out of the run."""
    ways = r"\b(?:add_test|gtest_discover_tests|gtest_add_tests)\s*\(|\bSKIP_REGULAR_EXPRESSION\b|\bSKIP_RETURN_CODE\b|\bWILL_FAIL\b|\bgtest_main\b"
    for path, number, match in lines_with(root / "tests", {".txt", ".cmake"}, ways):
        yield f"{path}:{number}: {match[0]}"
    for path, number, match in lines_with(root / "tests", {".cpp", ".h"}, r"\bDISABLED_\w+"):
        yield f"{path}:{number}: {match[0]}"


def is_built(path):
    """By a glob or by its name, in a CMakeLists.txt of its folder or above it."""
    for folder in path.parents:
        recipe = text_of(folder / "CMakeLists.txt")
        named = re.search(rf"(?<![\w.-]){re.escape(path.relative_to(folder).as_posix())}(?![\w.-])", recipe)
        globbed = "GLOB sources CONFIGURE_DEPENDS *.cpp" in recipe or (
            path.name.endswith("_test.cpp") and ("tegument_tests(" in recipe or "GLOB sources CONFIGURE_DEPENDS *_test.cpp" in recipe))
        if named or (globbed and folder == path.parent):
            return True
    return False


def every_test_is_built(root):
    for path in files(root / "tests", {".cpp"}):
        if re.search(r"^(?:TYPED_)?TEST(?:_[FP])?\(", text_of(path), re.M) and not is_built(path):
            yield f"{path}: no CMakeLists.txt builds it"
    for recipe in files(root / "tests", {".txt"}):
        folder, above = recipe.parent, text_of(recipe.parent.parent / "CMakeLists.txt")
        if recipe.name != "CMakeLists.txt" or folder == root / "tests" or folder.name in ("fuzz", "consumer"):
            continue
        if f"add_subdirectory({folder.name})" not in above:
            yield f"{recipe}: the folder above does not add it"


def listed_switches(root):
    return set(re.findall(r"`((?:FX|TEGUMENT)_\w+)", text_of(root / "docs" / "settings.md")))


def guard_of(path):
    """hlsl/scatter/seams.fxh: TEGUMENT_SCATTER_SEAMS_FXH."""
    parts = [part for part in path.with_suffix("").parts if part not in (".", "hlsl", "effects")]
    return f"TEGUMENT_{'_'.join(parts).upper()}_FXH"


def without_needs(path, code):
    """Code with every `#ifndef GUARD, #include "FILE", #endif` blanked out whose guard is the file's."""
    def blank(match):
        needed = pathlib.Path(os.path.normpath(path.parent / match[2]))
        return "\n" * match[0].count("\n") if guard_of(needed) == match[1] else match[0]
    return re.sub(r'^#ifndef (\w+)\n#include "([^"\n]+)"\n#endif\n', blank, code, flags=re.M)


def shaders_branch_on_targets_only_in_platform(root):
    """Conditionals elsewhere: include guards, those of needed files around their includes, FX_TECHNIQUES, and the switches that docs/settings.md lists."""
    allowed = listed_switches(root) | {"FX_TECHNIQUES"}
    for path in files(root / "hlsl", SOURCES) + files(root / "effects", SOURCES):
        if path.name in ("platform.fxh", "settings.fxh"):
            continue
        for number, line in enumerate(without_needs(path, without_comments(text_of(path))).splitlines(), 1):
            match = re.match(r"\s*#\s*(?:if|ifdef|ifndef|elif)\b(.*)", line)
            names = set(re.findall(r"[A-Za-z_]\w*", match[1])) - {"defined"} if match else set()
            for name in sorted(names - allowed - {guard_of(path)}):
                yield f"{path}:{number}: conditional on {name}"


def right_forms_know_no_setting(root):
    """In hlsl/ the setting is known to printed/, to settings.fxh, which chooses, and to constants.fxh."""
    flags = set(re.findall(r"^static const (?:bool|int) (\w+)", text_of(root / "hlsl" / "constants.fxh"), re.M))
    flags |= {"TEGUMENT_SETTING", "TEGUMENT_PEERS_AS_PRINTED", "kTgPeersAsPrinted"}
    for path in files(root / "hlsl", {".fxh"}):
        if path.parent.name == "printed" or path.name in ("settings.fxh", "constants.fxh"):
            continue
        for number, line in enumerate(without_comments(text_of(path)).splitlines(), 1):
            for name in sorted(set(re.findall(r"[A-Za-z_]\w*", line)) & flags):
                yield f"{path}:{number}: {name}: the form for a printed setting belongs into hlsl/printed"


def names_of_the_library_carry_one_prefix(root):
    """What a client of hlsl/ sees: functions tgName, structs TgName, constants kTgName, macros TG_NAME; TEGUMENT_NAME is what it defines itself.
    FX_NAME is between effects and the tools that read them. Effects keep Direct3D 9's spelling: platform.fxh defines its keywords for them, not for the library."""
    keywords = {"tex2D", "tex2Dlod", "tex2Dbias", "tex2Dgrad", "texCUBE", "texCUBElod", "texCUBEbias", "texCUBEgrad", "technique"}
    kinds = (
        (r"^(?:static |inline )?(?:(?:void|bool|int|uint|half|float)(?:[1-4](?:x[1-4])?)?|[A-Z]\w*) (\w+)\(", r"tg[A-Z]"),
        (r"^struct (\w+)", r"Tg[A-Z]"),
        (r"^static (?:const )?\w+ (\w+)(?!\w|\()", r"kTg[A-Z]"),
        (r"^\s*#\s*define (\w+)", r"TG_|TEGUMENT_|FX_(?:ENTRY|TECHNIQUES|SETTINGS|METADATA)$"),
    )
    for path in files(root / "hlsl", {".fxh"}):
        for number, line in enumerate(without_comments(text_of(path)).splitlines(), 1):
            for pattern, prefix in kinds:
                name = re.match(pattern, line)
                if name and not re.match(prefix, name[1]) and not (path.name == "platform.fxh" and name[1] in keywords):
                    yield f"{path}:{number}: {name[1]}"


def includes_of_shaders_are_guarded_by_their_name(root):
    """A file that only includes others needs no guard; what a file needs stands above its guard."""
    for path in files(root / "hlsl", {".fxh"}) + files(root / "effects", {".fxh"}):
        guard = guard_of(path)
        code = without_needs(path, without_comments(text_of(path)))
        if all(line.startswith("#include") for line in code.split("\n") if line.strip()):
            continue
        if not re.match(rf"\s*#ifndef {guard}\s+#define {guard}\b", code):
            yield f"{path}: the first two directives should be #ifndef {guard}, #define {guard}"


def shaders_name_their_licence(root):
    """In their last line: they are copied into engines one by one. REUSE.toml names that of all other files."""
    for path in files(root / "hlsl", {".fx", ".fxh"}) + files(root / "effects", {".fx", ".fxh"}):
        if not text_of(path).endswith("\n// SPDX-License-Identifier: MIT\n"):
            yield f"{path}: the last line should be // SPDX-License-Identifier: MIT"


def the_library_states_version_and_licence(root):
    """It is copied into engines without the files beside it."""
    path = root / "hlsl/tegument.fxh"
    if not path.exists():
        return
    text = text_of(path)
    licence = "".join(f"// {line}".rstrip() + "\n" for line in text_of(root / "LICENSE").strip().splitlines())
    if licence not in text:
        yield "hlsl/tegument.fxh: the text of LICENSE should stand in its head"
    platform = text_of(root / "hlsl/platform.fxh")
    major, minor, patch = map(int, re.search(r"project\(tegument VERSION (\d+)\.(\d+)\.(\d+)", text_of(root / "CMakeLists.txt")).groups())
    if f"#define TEGUMENT_VERSION {10000 * major + 100 * minor + patch}\n" not in platform:
        yield "hlsl/platform.fxh: TEGUMENT_VERSION should be the project's"


def folders_explain_themselves_in_at_most_30_lines(root):
    folders = ["cmake", "docs", "effects", "hlsl", "host", "meshprep", "tools", "lab", "tests"]
    for above in ("host", "tools", "lab"):
        folders += sorted(f"{above}/{path.name}" for path in (root / above).glob("*") if path.is_dir())
    for folder in folders:
        readme = root / folder / "README.md"
        if not readme.exists():
            yield f"{folder}: no README.md"
        elif folder != "docs" and len(text_of(readme).splitlines()) > MAX_README_LINES:
            yield f"{readme}: more than {MAX_README_LINES} lines"


def links_lead_somewhere(root):
    for path, number, match in lines_with(root, PROSE, r"\]\(([^)#\s]+)(?:#[^)]*)?\)"):
        if not re.match(r"[a-z]+:", match[1]) and not (path.parent / match[1]).exists():
            yield f"{path}:{number}: {match[1]}"


def user_pages(root):
    """What is for those who use Tegument: every page of docs/ but docs/design, which is for those who change it."""
    return [path for path in files(root / "docs", PROSE) if path.relative_to(root / "docs").parts[0] != "design"]


def user_pages_are_few_and_short(root):
    """At most 25 pages of 40,000 words together, so that a newcomer finds the way; derivations, proofs and tables belong to docs/design."""
    words = {path: len(text_of(path).split()) for path in user_pages(root)}
    if len(words) > MAX_USER_PAGES:
        yield f"docs: {len(words)} pages outside docs/design, at most {MAX_USER_PAGES}"
    if sum(words.values()) > MAX_USER_WORDS:
        longest = max(words, key=words.get)
        yield f"docs: {sum(words.values())} words outside docs/design, at most {MAX_USER_WORDS}; the longest page is {longest}, {words[longest]}"


def linked_pages(page):
    """The pages that this one links to, by their place."""
    links = re.findall(r"\]\(([^)#\s]+\.md)(?:#[^)]*)?\)", text_of(page))
    return {os.path.normpath(page.parent / link) for link in links if ":" not in link}


def every_page_is_listed_where_its_readers_begin(root):
    """docs/README.md, one screen, lists the users' pages, docs/design/README.md the others."""
    front, design = root / "docs" / "README.md", root / "docs" / "design" / "README.md"
    if len(text_of(front).splitlines()) > MAX_FRONT_LINES:
        yield f"{front}: more than {MAX_FRONT_LINES} lines"
    users = set(user_pages(root))
    for path in files(root / "docs", PROSE):
        start = front if path in users else design
        if path not in (front, design) and os.path.normpath(path) not in linked_pages(start):
            yield f"{start}: does not list {path}"


def names_of_the_settings_stand_in_one_place(root):
    """Programs read them from the effect; the rooms that judge the skin include what CMake makes of that line."""
    place = root / "hlsl" / "settings.fxh"
    line = re.search(r"^#define FX_SETTINGS \w+ (.*)$", text_of(place), re.M)
    names = line[1].split() if line else []
    otherwise = {"fur.cpp", "fur_roots.cpp", "prep_mesh.cpp"}  # "seed" of random numbers, and of an order of triangles
    for room in [*rooms.TOPS, "hlsl", "effects"]:
        for path in files(root / room, SOURCES):
            for number, text in enumerate(without_comments(text_of(path)).splitlines(), 1):
                if re.match(r"\s*#\s*include\b", text):
                    continue  # files may be called as the setting is
                for string in re.findall(r'"((?:\\.|[^"\\])*)"', text):
                    said = [n for n in names if string == n or (n.isalnum() and not n.isalpha() and n in string)]
                    if said and path != place and path.name not in otherwise:
                        yield f"{path}:{number}: \"{string}\" names a setting; they stand in {place.name}"


def included_by(root, path, seen):
    """Headers that a header includes, and those that they do."""
    for name in re.findall(r'^#include "(host/[^"]+)"', text_of(path), re.M):
        if name not in seen:
            seen.add(name)
            included_by(root, root / name, seen)
    return seen


def sources_that_use_algorithms_include_them(root):
    """GCC 12's other headers bring them along; those of GCC 14 and of libc++ do not."""
    used = r"\bstd::(?:ranges::(?!(?:begin|end|size|data|views?)\b)\w+|(?:max|min|minmax|clamp|(?:stable_|partial_)?sort|find(?:_if)?|count(?:_if)?|(?:any|all|none)_of|copy(?:_n|_if)?|" \
           r"fill(?:_n)?|transform|remove_if|reverse|rotate|unique|equal|(?:max|min|minmax)_element|(?:lower|upper)_bound|binary_search|generate)\()"
    for top in [*rooms.TOPS, "tests"]:
        for path in files(root / top, {".cpp", ".h"}):
            code = without_comments(text_of(path))
            if re.search(used, code) and "#include <algorithm>" not in code:
                yield f"{path}: uses an algorithm and does not include <algorithm>"


def headers_that_need_no_gpu_include_none(root):
    for path in files(root / "host", {".h"}):
        comment = " ".join(re.match(r"(?:#pragma once\n)?((?://.*\n)*)", text_of(path))[1].replace("//", "").split())
        if not re.search(r"[Nn]eeds no GPU|knows a GPU|[Nn]o GPU\b", comment):
            continue
        for name in sorted(n for n in included_by(root, path, set()) if n.startswith("host/gpu/")):
            yield f"{path}: says that it needs no GPU, and includes {name}"


def nothing_but_tests_reads_the_shared_folder(root):
    """A test may default an environment variable to it; documents and the program make sense without it."""
    for path, number, match in lines_with(root, SOURCES | PROSE | SCRIPTS, r"\.\./" + r"shared\b"):
        if path.relative_to(root).parts[0] != "tests":
            yield f"{path}:{number}: {match[0]}"


def dependencies_are_those_that_bootstrap_installs(root):
    script = "".join(text_of(file) for file in (root / "bootstrap", root / "meshprep" / "fetch.py") if file.exists())
    page = text_of(root / "docs" / "dependencies.md")
    groups = re.findall(r"^\w+_packages=\(([^)]*)\)", script, re.M)
    installed = {name for group in groups for name in group.split()}
    listed = set(re.findall(r"^\| apt \| `([^`]+)`", page, re.M))
    yield from (f"bootstrap installs {name}, docs/dependencies.md does not list it" for name in sorted(installed - listed))
    yield from (f"docs/dependencies.md lists {name}, bootstrap does not install it" for name in sorted(listed - installed))
    for pin in re.findall(r"\b[0-9a-f]{64}\b|[\w.]+==[\d.]+", script):
        if pin not in page:
            yield f"bootstrap pins {pin}, docs/dependencies.md does not say so"


CHECKS = {
    function.__name__: function
    for function in (
        shaders_have_lines_of_at_most_140_characters,
        no_file_names_a_registry_host_or_a_path_of_one_machine,
        nothing_is_left_unfinished,
        the_page_of_diagnostics_is_made_from_its_table,
        every_diagnostic_code_is_documented,
        every_documented_code_can_be_raised,
        every_diagnostic_code_is_tested,
        rooms_include_each_other_without_a_cycle,
        data_goes_down_from_folder_to_folder,
        the_host_serves_every_effect_alike,
        some_libraries_are_known_to_one_room,
        public_headers_are_meant_for_users,
        the_changelog_knows_the_version_that_is_built,
        cpp_files_are_formatted,
        tests_are_registered_where_no_failure_is_lost,
        every_test_is_built,
        shaders_branch_on_targets_only_in_platform,
        right_forms_know_no_setting,
        names_of_the_library_carry_one_prefix,
        includes_of_shaders_are_guarded_by_their_name,
        shaders_name_their_licence,
        the_library_states_version_and_licence,
        folders_explain_themselves_in_at_most_30_lines,
        links_lead_somewhere,
        user_pages_are_few_and_short,
        every_page_is_listed_where_its_readers_begin,
        every_test_that_the_conventions_name_exists,
        names_of_the_settings_stand_in_one_place,
        sources_that_use_algorithms_include_them,
        headers_that_need_no_gpu_include_none,
        nothing_but_tests_reads_the_shared_folder,
        dependencies_are_those_that_bootstrap_installs,
    )
}


def main(arguments):
    if arguments == ["--list"]:
        print("\n".join(CHECKS))
        return 0
    if not arguments or arguments[0] not in CHECKS:
        print(__doc__, file=sys.stderr)
        return 2
    os.chdir(arguments[1] if len(arguments) > 1 else pathlib.Path(__file__).resolve().parents[2])
    try:
        findings = list(CHECKS[arguments[0]](pathlib.Path(".")))
    except Skip as reason:
        print(f"skipped: {reason}")
        return SKIPPED
    print("\n".join(findings) or "no findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
