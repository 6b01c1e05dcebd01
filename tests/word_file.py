"""A Word document read back: its parts as XML, and the text that it shows."""

import io
import re
import zipfile
from xml.etree import ElementTree

NAMES = {
    "w": "http://schemas.openxmlformats.org/wordprocessingml/2006/main",
    "m": "http://schemas.openxmlformats.org/officeDocument/2006/math",
    "wp": "http://schemas.openxmlformats.org/drawingml/2006/wordprocessingDrawing",
    "dc": "http://purl.org/dc/elements/1.1/",
}


def name(qualified):
    """Return a name such as w:p as ElementTree has it."""
    prefix, _, local = qualified.partition(":")
    return f"{{{NAMES[prefix]}}}{local}"


def text_of(element):
    """Return the text of an element, its paragraphs on lines of their own."""
    shown = []
    for part in element.iter():
        if part.tag in (name("w:t"), name("m:t")):
            shown.append(part.text or "")
        elif part.tag == name("w:p"):
            shown.append("\n")
    return "".join(shown)


class WordFile:
    """A Word document, every part of which is well-formed."""

    def __init__(self, content):
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            self.files = {file: archive.read(file) for file in archive.namelist()}
        self.parts = {
            re.sub(r".*/|\.xml$", "", file): ElementTree.fromstring(data)
            for file, data in self.files.items()
            if file.endswith(".xml")
        }
        self.parts["body"] = self.parts.pop("document")
        self.text = text_of(self.parts["body"])

    def all(self, part, qualified):
        """Return the elements of a part that are called so."""
        return list(self.parts[part].iter(name(qualified)))

    @staticmethod
    def get(element, attribute):
        """Return an attribute such as w:val."""
        return element.get(name(attribute))
