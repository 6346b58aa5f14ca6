"""What mkdocs does besides: the C++ reference in the navigation, links to headers and anchors."""

import logging
import posixpath
import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from mkdocs.structure.files import Files

log = logging.getLogger("mkdocs.hooks")  # its warnings count in a strict build
logging.getLogger("mkdocs").setLevel(logging.WARNING)  # no word about what went well

HEADER_LINK = re.compile(r"\]\((?:\.\./)*include/nbvopt/(\w+)/(\w+)\.hpp\)")


def on_config(config):
    pages = sorted(Path(config["docs_dir"], "reference").glob("*.md"))
    modules = [{page.stem: f"reference/{page.name}"} for page in pages if page.stem != "index"]
    config["nav"].append({"C++ reference": [{"Headers": "reference/index.md"}, *modules]})
    return config


def on_files(files, config):
    return Files([file for file in files if not file.src_path.startswith("docs/site/")])


def on_page_markdown(markdown, page, config, files):
    """Links to public headers lead to the reference."""
    root = posixpath.relpath(".", posixpath.dirname(page.file.src_path) or ".")
    return HEADER_LINK.sub(rf"]({root}/reference/\1.md#\2hpp)", markdown)


class Links(HTMLParser):
    """The anchors of a page, and where it leads."""

    def __init__(self, html):
        super().__init__()
        self.anchors, self.targets = set(), set()
        self.feed(html)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.anchors.add(attributes.get("id"))
        if tag in ("a", "img"):
            self.targets.add(attributes.get("href") or attributes.get("src") or "")


def on_post_build(config):
    """Every link within the site leads to a file, and to an anchor that is in it."""
    site = Path(config["site_dir"])
    pages = {path: Links(path.read_text()) for path in site.rglob("*.html")}
    del pages[site / "404.html"]  # leads to places below a server's root
    for path, links in pages.items():
        for target in sorted(links.targets):
            url = urlsplit(target)
            if url.scheme or url.netloc:
                continue
            file = (path.parent / unquote(url.path)).resolve() if url.path else path
            file = file / "index.html" if file.is_dir() else file
            known = pages[file].anchors if file in pages else set()
            if not file.exists() or (url.fragment and unquote(url.fragment) not in known):
                log.warning("%s: the link '%s' leads nowhere", path.relative_to(site), target)
