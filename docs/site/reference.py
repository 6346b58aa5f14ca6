"""Makes the pages of the C++ reference, one a module, from what Doxygen read in the headers.

    python3 docs/site/reference.py XML_DIR INCLUDE_DIR OUT_DIR

Declarations stand in the order of the headers. What is private, defaulted, deleted or in another
namespace than nbvopt is left out.
"""

import re
import sys
import xml.etree.ElementTree as ElementTree
from html import escape
from pathlib import Path

NAMESPACE = "nbvopt::"


def text_of(element, tag):
    return (element.findtext(tag) or "").strip()


def file_of(element):
    return Path(element.find("location").get("file"))


def line_of(element):
    return int(element.find("location").get("line"))


def name_of(element):
    """Such as PlanRequest, or StopRule::Clock."""
    name = text_of(element, "compoundname") or text_of(element, "qualifiedname")
    return name.removeprefix(NAMESPACE)


def title_of(element):
    """The heading of a class or an enumeration."""
    return f"{element.get('kind')} {name_of(element)}"


def anchor_of(title):
    """What mkdocs makes of a heading."""
    return re.sub(r"\s+", "-", re.sub(r"[^\w\s-]", "", title).strip().lower())


def is_listed(element):
    """Whether a class or a member is neither private nor written by the compiler."""
    name = text_of(element, "name")
    return not (
        element.get("prot") == "private"
        or element.get("kind") == "friend"
        or name.startswith("~")
        or name == "operator="
        or re.search(r"=\s*(default|delete)$", text_of(element, "argsstring"))
    )


def in_namespace(element):
    name = text_of(element, "compoundname") or text_of(element, "qualifiedname")
    return name.startswith(NAMESPACE) and "detail::" not in name


def plain(text):
    """Text in which Markdown sees nothing special."""
    return re.sub(r"([\\`*_\[\]#|])", r"\\\1", escape(text, quote=False))


def plain_html(text):
    """The same, within HTML tags."""
    marks = {mark: f"&#{ord(mark)};" for mark in "\\`*_[]#|"}
    return "".join(marks.get(letter, letter) for letter in escape(text, quote=False))


class Header:
    """A header: what it declares, and the comment at its head."""

    def __init__(self, path, declarations, include):
        self.path = path  # such as nbvopt/planner/planner.hpp
        self.module = path.parts[1]
        self.anchor = anchor_of(path.name)
        self.declarations = sorted(declarations, key=line_of)
        self.comment = []
        for line in (include / path).read_text().splitlines():
            if not line.startswith("//"):
                break
            self.comment.append(line.removeprefix("//").removeprefix(" "))

    def subject(self):
        """The first sentence or paragraph of the comment."""
        return " ".join(self.comment).partition("  ")[0]


def read_headers(xml, include):
    declared = {}
    for path in sorted(xml.glob("*.xml")):
        for compound in ElementTree.parse(path).getroot().iter("compounddef"):
            kind = compound.get("kind")
            if kind in ("class", "struct"):
                found = [compound]
            elif kind == "namespace":
                found = compound.iter("memberdef")
            else:
                found = []
            if kind == "file":
                declared.setdefault(file_of(compound), [])
            for element in found:
                if is_listed(element) and in_namespace(element):
                    declared.setdefault(file_of(element), []).append(element)
    return [Header(path, declared[path], include) for path in sorted(declared)]


class Writer:
    """Writes declarations as Markdown, with links between them."""

    def __init__(self, headers):
        self.links = {  # by Doxygen's id
            element.get("id"): f"{header.module}.html#{anchor_of(title_of(element))}"
            for header in headers
            for element in header.declarations
            if element.get("kind") in ("class", "struct", "enum", "typedef")
        }

    def header(self, header):
        yield from [f"## {header.path.name}", ""]
        yield from [f"`#include <{header.path}>`", ""]
        for line in header.comment:  # formulas are set in
            yield f"    {line}" if line.startswith("  ") else plain(line)
        yield ""
        yield from self.members(header.declarations)

    def members(self, members):
        """Constants and fields in a table, then the rest."""
        fields = [member for member in members if member.get("kind") == "variable"]
        if fields:
            yield from self.fields(fields)
        for member in members:
            if member.get("kind") == "function":
                yield from self.signature(member, self.function(member))
            elif member.get("kind") == "typedef":
                type_ = self.code(member.find("type"))
                yield from self.signature(
                    member, f"using <b>{plain_html(text_of(member, 'name'))}</b> = {type_}"
                )
            elif member.get("kind") == "enum":
                yield from self.enum(member)
            elif member.get("kind") in ("class", "struct"):
                yield from self.class_(member)

    def class_(self, class_):
        yield from [f"### {escape(title_of(class_))}", ""]
        bases = [self.code(base, class_) for base in class_.findall("basecompoundref")]
        if bases:
            yield from [f"Derives from {', '.join(f'<code>{base}</code>' for base in bases)}.", ""]
        yield from [self.comment(class_), ""]
        members = filter(is_listed, class_.iter("memberdef"))
        yield from self.members(sorted(members, key=line_of))

    def enum(self, enum):
        yield from [f"### {escape(title_of(enum))}", ""]
        yield from [self.comment(enum), "", "| value | |", "| --- | --- |"]
        for value in enum.findall("enumvalue"):
            yield self.row([plain_html(text_of(value, "name"))], value)
        yield ""

    def fields(self, fields):
        yield from ["| name | type | default | |", "| --- | --- | --- | --- |"]
        for field in fields:
            name = plain_html(text_of(field, "name"))
            default = self.code(field.find("initializer")).removeprefix("=").strip()
            yield self.row([name, self.code(field.find("type")), default], field)
        yield ""

    def row(self, codes, described):
        cells = [f"<code>{code}</code>" if code else "" for code in codes]
        return f"| {' | '.join(cells)} | {self.comment(described, between='<br>')} |"

    def signature(self, member, code):
        id_ = f' id="{anchor_of(title_of(member))}"' if member.get("kind") == "typedef" else ""
        yield f'<div class="signature"{id_}><code>{code}</code></div>'
        yield from ['<div class="said" markdown="1">', "", self.comment(member), "", "</div>", ""]

    def function(self, function):
        parameters = []
        for parameter in function.findall("param"):
            default = self.code(parameter.find("defval"))
            parameters.append(
                self.code(parameter.find("type"))
                + f" {plain_html(text_of(parameter, 'declname'))}".rstrip()
                + (f" = {default}" if default else "")
            )
        words = [
            "static" if function.get("static") == "yes" else "",
            "explicit" if function.get("explicit") == "yes" else "",
            "virtual" if function.get("virt") in ("virtual", "pure-virtual") else "",
            self.code(function.find("type")),
            f"<b>{plain_html(text_of(function, 'name'))}</b>({', '.join(parameters)})",
            text_of(function, "argsstring").rpartition(")")[2].strip().replace("=0", "= 0"),
        ]
        return " ".join(filter(None, words))

    def comment(self, element, between="\n\n"):
        paragraphs = [
            self.mixed(paragraph, plain).strip()
            for tag in ("briefdescription", "detaileddescription")
            for paragraph in element.find(tag).iter("para")
        ]
        return between.join(filter(None, paragraphs))

    def code(self, element, parent=None):
        """A type, a default or a base class."""
        if element is None:
            return ""
        html = self.mixed(element, plain_html)
        if parent is not None:
            html = self.linked(element, html.removeprefix(NAMESPACE))
        html = re.sub(r" (&amp;|&#42;)", r"\1", html)  # const Map &  ->  const Map&
        html = html.replace("&lt; ", "&lt;").replace(" &gt;", "&gt;")
        return html.replace("std::numeric&#95;limits&lt;double&gt;::quiet&#95;NaN()", "NaN").strip()

    def mixed(self, element, written):
        """Text with what stands in it, by `written`."""
        parts = [written(element.text or "")]
        for child in element:
            inner = self.mixed(child, written)
            if child.tag == "computeroutput":
                inner = f"<code>{inner}</code>"
            parts += [self.linked(child, inner), written(child.tail or "")]
        return "".join(parts)

    def linked(self, element, html):
        link = self.links.get(element.get("refid"))
        return f'<a href="{link}">{html}</a>' if link else html


def main(xml, include, out):
    headers = read_headers(Path(xml), Path(include))
    writer = Writer(headers)
    pages = {}
    overview = ["# C++ reference", "", "The public headers, module by module.", ""]
    for header in headers:
        if header.module not in pages:
            pages[header.module] = [f"# {header.module}", ""]
            overview += ["", f"## {header.module}", "", "| header | |", "| --- | --- |"]
        pages[header.module] += writer.header(header)
        link = f"[{header.path.name}]({header.module}.md#{header.anchor})"
        overview.append(f"| {link} | {plain(header.subject())} |")

    Path(out).mkdir(parents=True, exist_ok=True)
    for name, lines in {**pages, "index": overview}.items():
        Path(out, f"{name}.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
