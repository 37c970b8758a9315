"""Figures and documents."""

from __future__ import annotations

from hashlib import sha256
from html import escape
from os import PathLike, fspath
from pathlib import Path

from . import _native

Named = list[tuple[str, _native.Picture]]


def _ending(path: str | PathLike[str], known: tuple[str, ...]) -> tuple[Path, str]:
    at = Path(fspath(path))
    ending = at.suffix.lower().lstrip(".")
    if ending not in known:
        *first, last = [f".{name}" for name in known]
        raise ValueError(f"{at} ends in none of {', '.join(first)} and {last}")
    return at, ending


def _framed(page: str, height: int) -> str:
    return f'<iframe srcdoc="{escape(page)}" style="width:100%;height:{height}px;border:0"></iframe>'


class Figure:
    """A figure: one page or several. A notebook shows it."""

    def __init__(self, pages: Named) -> None:
        self._pages = pages

    @property
    def names(self) -> list[str]:
        """The names of the pages."""
        return [name for name, _ in self._pages]

    @property
    def pages(self) -> list[Figure]:
        """Each page as a figure."""
        return [Figure([page]) for page in self._pages]

    def _only(self) -> _native.Picture:
        if len(self._pages) != 1:
            raise ValueError(f"the figure has {len(self._pages)} pages: take one of .pages, or .pdf()")
        return self._pages[0][1]

    @property
    def size_mm(self) -> tuple[float, float]:
        """Width and height (mm) of the only page."""
        return self._only().size_mm

    @property
    def svg(self) -> str:
        """The only page as SVG; letters are outlines."""
        return self._only().svg()

    def editable_svg(self) -> str:
        """The only page as SVG with letters as text, for drawing programs."""
        return self._only().svg(editable=True)

    def png(self, dpi: float = 200) -> bytes:
        """The only page as PNG."""
        return self._only().png(dpi)

    def pdf(self) -> bytes:
        """All pages as PDF, vectors throughout."""
        return _native.pdf_of([picture for _, picture in self._pages])

    def save(self, path: str | PathLike[str], *, dpi: float = 200) -> list[Path]:
        """Writes `.svg`, `.png` or `.pdf` by the ending of the name; returns the files.

        Several pages are one PDF, or files `NAME-PAGE.svg` and so on.
        """
        at, ending = _ending(path, ("svg", "png", "pdf"))
        if ending == "pdf":
            at.write_bytes(self.pdf())
            return [at]
        written = []
        for name, page in zip(self.names, self.pages):
            out = at if len(self._pages) == 1 else at.with_name(f"{at.stem}-{name}{at.suffix}")
            out.write_bytes(page.svg.encode() if ending == "svg" else page.png(dpi))
            written.append(out)
        return written

    def _inline(self) -> str:
        # The ids of several figures in one document differ.
        out = []
        for _, picture in self._pages:
            digest = sha256(picture.svg().encode()).hexdigest()
            out.append(picture.svg(prefix=f"h{digest[:8]}-"))
        return "".join(out)

    def _repr_svg_(self) -> str | None:
        return self._inline() if len(self._pages) == 1 else None

    def _repr_html_(self) -> str | None:
        return None if len(self._pages) == 1 else f"<div>{self._inline()}</div>"

    def __repr__(self) -> str:
        words = ", ".join(name or "sheet" for name in self.names)
        return f"<hodograph.Figure: {words}>"


class Worksheet:
    """A problem with its solution. A notebook shows it."""

    def __init__(self, native: _native.Sheet) -> None:
        self._native = native

    @property
    def title(self) -> str:
        """The title."""
        return self._native.title

    @property
    def html(self) -> str:
        """One HTML page with MathML and its drawings."""
        return self._native.html()

    def pdf(self) -> bytes:
        """Pages of A4."""
        return self._native.pdf()

    def save(self, path: str | PathLike[str]) -> list[Path]:
        """Writes `.pdf`, `.html`, `.md` or `.typ` by the ending of the name; returns the files.

        Markdown and Typst have their drawings beside them.
        """
        at, ending = _ending(path, ("pdf", "html", "md", "typ"))
        if ending == "pdf":
            at.write_bytes(self.pdf())
            return [at]
        if ending == "html":
            at.write_bytes(self.html.encode())
            return [at]
        write = self._native.markdown if ending == "md" else self._native.typst
        text, beside = write(at.stem)
        written = [at]
        at.write_bytes(text.encode())
        for name, drawing in beside:
            written.append(at.with_name(name))
            written[-1].write_bytes(drawing.encode())
        return written

    def _repr_html_(self) -> str:
        return _framed(self.html, 700)

    def __repr__(self) -> str:
        return f"<hodograph.Worksheet: {self.title}>"


class Frame:
    """A sheet to draw on (the mechanism to scale, poles, scales, the space for the polygons), and
    the solution to lay over it."""

    def __init__(self, sheet: Figure, overlay: Figure) -> None:
        self.sheet = sheet
        """The pages to draw on."""
        self.overlay = overlay
        """The solution on pages of the same size."""

    def save(self, path: str | PathLike[str]) -> list[Path]:
        """Writes `NAME.pdf` and `NAME-overlay.pdf`; returns the files."""
        at, _ = _ending(path, ("pdf",))
        return [*self.sheet.save(at), *self.overlay.save(at.with_name(f"{at.stem}-overlay.pdf"))]

    def _repr_html_(self) -> str:
        return f"<div>{self.sheet._inline()}</div>"

    def __repr__(self) -> str:
        return f"<hodograph.Frame: {len(self.sheet.pages)} pages>"


class Lesson:
    """A page with the construction step by step, and a driver to drag. A notebook shows it."""

    def __init__(self, html: str) -> None:
        self.html = html
        """The page, which needs no other file."""

    def save(self, path: str | PathLike[str]) -> Path:
        """Writes the page, `.html`."""
        at, _ = _ending(path, ("html", "htm"))
        at.write_bytes(self.html.encode())
        return at

    def _repr_html_(self) -> str:
        return _framed(self.html, 900)

    def __repr__(self) -> str:
        return f"<hodograph.Lesson: {len(self.html) // 1000} kB>"
