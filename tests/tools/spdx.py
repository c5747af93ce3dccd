#!/usr/bin/env python3
"""What Tegument is built from and runs with, as an SPDX 2.3 document in JSON: spdx.py [ROOT] > tegument.spdx.json
   spdx.py --check [ROOT]    exit code 1 where the document would not hold all of docs/dependencies.md

Made from the tables of docs/dependencies.md, which a test holds against what bootstrap installs. No date, no random number: the same tables give
the same bytes.
"""

import hashlib
import json
import pathlib
import re
import sys

# What the tables say, in SPDX's own identifiers where it has one.
LICENCES = {
    "GPL-3.0 with runtime exception": "GPL-3.0-only WITH GCC-exception-3.1", "Apache-2.0 with LLVM exception": "Apache-2.0 WITH LLVM-exception",
    "IJG, BSD-3-Clause": "IJG AND BSD-3-Clause", "Apache-2.0, MIT": "Apache-2.0 AND MIT", "BSD-3-Clause, Apache-2.0, MIT": "BSD-3-Clause AND Apache-2.0 AND MIT",
    "FTL or GPL-2.0": "FTL OR GPL-2.0-only", "libpng-2.0": "libpng-2.0", "Zlib": "Zlib", "HPND": "HPND", "PSF-2.0": "PSF-2.0", "Info-ZIP": "Info-ZIP",
}
PLAIN = {"MIT", "MPL-2.0", "BSD-2-Clause", "BSD-3-Clause", "Apache-2.0", "GPL-2.0-or-later", "LGPL-2.1-or-later"}


def rows(page):
    """Client, package, version, sha256, licence of every row."""
    for line in page.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) < 6 or cells[0] not in ("apt", "pip", "cargo"):
            continue
        name, _, version = cells[1].strip("`").partition("==")
        if cells[0] != "apt":
            yield cells[0], name, version, cells[2].strip("`"), cells[3]
        else:
            yield cells[0], name, cells[2], "", cells[3]


def licence(text, others):
    """SPDX's expression; for other words a reference to them."""
    known = LICENCES.get(text, text if text in PLAIN else None)
    if known:
        return known
    name = "LicenseRef-" + re.sub(r"[^A-Za-z0-9]+", "-", text).strip("-")
    others[name] = text
    return name


def package(client, name, version, checksum, concluded):
    entry = {"SPDXID": f"SPDXRef-{client}-{re.sub(r'[^A-Za-z0-9.-]', '-', name)}", "name": name, "versionInfo": version, "filesAnalyzed": False,
             "downloadLocation": "NOASSERTION", "licenseDeclared": concluded, "licenseConcluded": concluded, "copyrightText": "NOASSERTION",
             "comment": "from Debian 12, by apt" if client == "apt" else f"read as an archive, by {client}"}
    if checksum:
        entry["checksums"] = [{"algorithm": "SHA256", "checksumValue": checksum}]
    return entry


def document(root):
    page = (root / "docs/dependencies.md").read_text(encoding="utf-8")
    version = re.search(r"project\(tegument VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
    others = {}
    packages = [package(client, name, number, checksum, licence(text, others)) for client, name, number, checksum, text in rows(page)]
    own = {"SPDXID": "SPDXRef-tegument", "name": "tegument", "versionInfo": version, "filesAnalyzed": False, "downloadLocation": "NOASSERTION",
           "licenseDeclared": "NOASSERTION", "licenseConcluded": "NOASSERTION", "copyrightText": "NOASSERTION", "comment": "licence: the file LICENSE"}
    digest = hashlib.sha256(page.encode()).hexdigest()
    return {
        "spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"tegument-{version}",
        "documentNamespace": f"urn:tegument:{version}:{digest}",
        "creationInfo": {"created": "1970-01-01T00:00:00Z", "creators": ["Tool: tests/tools/spdx.py"]},
        "packages": [own, *packages],
        "hasExtractedLicensingInfos": [{"licenseId": name, "name": text, "extractedText": text} for name, text in sorted(others.items())],
        "relationships": [{"spdxElementId": "SPDXRef-DOCUMENT", "relationshipType": "DESCRIBES", "relatedSpdxElement": "SPDXRef-tegument"}] +
                         [{"spdxElementId": "SPDXRef-tegument", "relationshipType": "DEPENDS_ON", "relatedSpdxElement": entry["SPDXID"]}
                          for entry in packages],
    }


def faults(root):
    made = document(root)
    names = [entry["name"] for entry in made["packages"][1:]]
    page = (root / "docs/dependencies.md").read_text(encoding="utf-8")
    for client, name in re.findall(r"^\| (apt|pip|cargo) \| `([^`=]+)", page, re.M):
        if name not in names:
            yield f"{client} {name} is not in the document"
    if len({entry["SPDXID"] for entry in made["packages"]}) != len(made["packages"]):
        yield "two packages have one identifier"
    for entry in made["packages"][1:]:
        if not entry["versionInfo"] or not re.match(r"[\w.+-]", entry["versionInfo"]):
            yield f"{entry['name']} has no version"
        if not re.fullmatch(r"[A-Za-z0-9.+-]+( (AND|OR|WITH) [A-Za-z0-9.+-]+)*", entry["licenseDeclared"]):
            yield f"{entry['name']}: '{entry['licenseDeclared']}' is no expression"
        if any(len(sum_["checksumValue"]) != 64 for sum_ in entry.get("checksums", [])):
            yield f"{entry['name']}: no SHA-256"
    if len(names) < 40:
        yield f"{len(names)} packages only: the tables were not read"


def main(arguments):
    check = arguments[:1] == ["--check"]
    root = pathlib.Path((arguments[check:] or ["."])[0])
    if not check:
        print(json.dumps(document(root), indent=1))
        return 0
    found = list(faults(root))
    print("\n".join(found) or "no findings")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
