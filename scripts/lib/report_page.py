"""A web page in one file: tables, texts and pictures."""

from __future__ import annotations

import base64
import html
import io
from collections.abc import Iterable, Sequence

from figure_style import plt, use_plain_ticks

STYLE = """
body {font: 15px/1.5 system-ui, sans-serif; color: #1a1a1a;
      max-width: 1120px; margin: 2em auto; padding: 0 1.2em}
h1 {font-size: 1.6em; margin-bottom: 0.2em}
h2 {font-size: 1.2em; margin-top: 2em; border-bottom: 1px solid #ccc}
p.sub {color: #555; margin: 0.2em 0}
.scroll {overflow-x: auto}
table {border-collapse: collapse; margin: 0.8em 0}
th, td {text-align: left; padding: 0.25em 1.2em 0.25em 0;
        border-bottom: 1px solid #e5e5e5; vertical-align: top}
th {font-weight: 600}
td + td {min-width: 6em}
tr > th:first-child {white-space: nowrap}
figure {margin: 0}
.grid {display: flex; flex-wrap: wrap; gap: 1.2em 1.6em; align-items: start}
img {max-width: 100%; height: auto}
pre {background: #f6f6f6; padding: 1em; overflow-x: auto; font-size: 13px;
     line-height: 1.4}
.warning {background: #fff4e0; border-left: 4px solid #E69F00;
          padding: 0.4em 1em; margin: 0.6em 0; overflow-wrap: anywhere}
.error {background: #fdeaea; border-left: 4px solid #B00020;
        padding: 0.4em 1em; margin: 0.6em 0; overflow-wrap: anywhere}
@media print {figure, tr {break-inside: avoid} pre {white-space: pre-wrap}}
"""


def svg(figure) -> tuple[str, bytes]:
    """The drawing of a figure, which is then closed."""
    stream = io.BytesIO()
    use_plain_ticks(figure)
    with plt.rc_context({"svg.hashsalt": "synovia", "savefig.dpi": 200}):
        figure.savefig(stream, format="svg", metadata={"Date": None})
    plt.close(figure)
    return "image/svg+xml", stream.getvalue()


class Page:
    """Collects the parts of a page, in order. Texts are taken literally."""

    def __init__(self, title: str, subtitle: Sequence[str] = ()):
        self._title = title
        self._parts = [f"<h1>{html.escape(title)}</h1>"]
        self._parts += [f'<p class="sub">{html.escape(line)}</p>'
                        for line in subtitle if line]
        self._place_of_problems = len(self._parts)
        self._errors: list[str] = []
        self._warnings: list[str] = []

    def heading(self, text: str) -> None:
        self._parts.append(f"<h2>{html.escape(text)}</h2>")

    def text(self, text: str) -> None:
        self._parts.append(f"<p>{html.escape(text)}</p>")

    def list(self, texts: Iterable[str]) -> None:
        items = "\n".join(f"<li>{html.escape(text)}</li>" for text in texts)
        self._parts.append(f"<ul>\n{items}\n</ul>")

    def error(self, text: str) -> None:
        """To stand at the top of the page."""
        self._errors.append('<p class="error"><b>Error:</b> '
                            f"{html.escape(text)}</p>")

    def warn(self, text: str) -> None:
        """To stand at the top of the page, below the errors."""
        self._warnings.append('<p class="warning"><b>Warning:</b> '
                              f"{html.escape(text)}</p>")

    def literal(self, text: str) -> None:
        self._parts.append(f"<pre>{html.escape(text)}</pre>")

    def table(self, rows: Iterable[Sequence[str]],
              headings: Sequence[str] = ()) -> None:
        """Rows of cells; without headings, each row's first cell is one."""
        lines = []
        if headings:
            lines.append("".join(f"<th>{html.escape(cell)}</th>"
                                 for cell in headings))
        for first, *others in rows:
            kind = "td" if headings else "th"
            lines.append(f"<{kind}>{html.escape(first)}</{kind}>" + "".join(
                f"<td>{html.escape(cell)}</td>" for cell in others))
        body = "\n".join(f"<tr>{line}</tr>" for line in lines)
        self._parts.append(f'<div class="scroll"><table>\n{body}\n</table>'
                           "</div>")

    def pictures(self,
                 pictures: Iterable[tuple[str, tuple[str, bytes]]]) -> None:
        """Descriptions with (MIME type, bytes)."""
        figures = [
            f'<figure><img alt="{html.escape(name)}" src="data:{kind};'
            f'base64,{base64.b64encode(data).decode()}"></figure>'
            for name, (kind, data) in pictures]
        self._parts.append('<div class="grid">\n' + "\n".join(figures)
                           + "\n</div>")

    def __str__(self) -> str:
        at = self._place_of_problems
        parts = (self._parts[:at] + self._errors + self._warnings
                 + self._parts[at:])
        return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n'
                '<meta charset="utf-8">\n'
                '<meta name="viewport" content="width=device-width">\n'
                f"<title>{html.escape(self._title)}</title>\n"
                f"<style>{STYLE}</style>\n</head>\n<body>\n"
                + "\n".join(parts) + "\n</body>\n</html>\n")
