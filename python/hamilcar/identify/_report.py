"""Reports of an identification."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._result import Fit, Identification

_STYLE = """body{font:15px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:#222}
table{border-collapse:collapse;margin:1rem 0}td,th{padding:.2rem .7rem;border-bottom:1px solid #ddd;text-align:right}
td:first-child,th:first-child{text-align:left}svg{width:100%;height:auto}.warning{color:#a33}figcaption{font-size:13px}
figure{margin:1rem 0}"""


def rows_of(found: Identification) -> list[tuple[str, ...]]:
    intervals = found.intervals
    return [
        (
            name, f"{found.values[name]:.6g}", f"{found.standard_errors[name]:.2g}", f"{intervals[name][0]:.5g}",
            f"{intervals[name][1]:.5g}", f"{found.starts[name]:.5g}", found.units[name],
        )
        for name in found.names
    ]


_HEAD = ("unknown", "value", "standard error", "95 % from", "to", "start", "unit")
_FIT_HEAD = ("run", "channel", "samples", "sd of residuals", "stated sd", "unit", "autocorrelation", "Durbin-Watson")


def fit_rows_of(found: Identification) -> list[tuple[str, ...]]:
    return [
        (
            fit.run, fit.channel, str(fit.time.size), f"{fit.sd:.3g}", f"{fit.stated_sd:.3g}", fit.unit,
            f"{fit.autocorrelation:.2f}", f"{fit.durbin_watson:.2f}",
        )
        for fit in found.fits
    ]


def _columns(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    widths = [max(len(row[i]) for row in [head, *rows]) for i in range(len(head))]
    return "\n".join(
        "  ".join(cell.ljust(width) if i == 0 else cell.rjust(width) for i, (cell, width) in enumerate(zip(row, widths))).rstrip()
        for row in [head, *rows]
    )


def _summary(found: Identification) -> str:
    return (
        f"reduced chi-square {found.reduced_chi_square:.3g}, {found.degrees_of_freedom} degrees of freedom, "
        f"{found.evaluations} evaluations, "
        + ("one start" if len(found.start_costs) == 1 else f"{len(found.start_costs)} starts")
    )


def _weakest(found: Identification) -> list[str]:
    return [f"{one.sd:.3g}: {one}" for one in found.directions[::-1][:3]]


def text_of(found: Identification) -> str:
    parts = [
        _columns(_HEAD, rows_of(found)), _summary(found), _columns(_FIT_HEAD, fit_rows_of(found)),
        "least known combinations, in scales:\n" + "\n".join("  " + line for line in _weakest(found)),
    ]
    if found.warnings:
        parts.append("\n".join(f"warning: {line}" for line in found.warnings))
    return "\n\n".join(parts) + "\n"


def _html_table(head: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    def line(tag: str, row: tuple[str, ...]) -> str:
        return "<tr>" + "".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in row) + "</tr>"

    return "<table>" + line("th", head) + "".join(line("td", row) for row in rows) + "</table>"


def table_of(found: Identification) -> str:
    return _html_table(_HEAD, rows_of(found)) + "".join(f'<p class="warning">{escape(line)}</p>' for line in found.warnings)


def html_of(found: Identification) -> str:
    k = len(found.names)
    lower = [[f"{found.correlation[i, j]:.2f}" if j <= i else "" for j in range(k)] for i in range(k)]
    correlation = [(f"{i + 1} {name}", *cells) for i, (name, cells) in enumerate(zip(found.names, lower))]
    title = escape(f"Identification of {found.vehicle.name}")
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title><style>{_STYLE}</style>'
        f"<h1>{title}</h1>{table_of(found)}<p>{escape(_summary(found))}</p>"
        f"<h2>Least known combinations</h2><p>Standard deviation, each unknown divided by its scale.</p><ul>"
        + "".join(f"<li>{escape(line)}</li>" for line in _weakest(found))
        + f"</ul><h2>Correlation</h2>{_html_table(('', *map(str, range(1, k + 1))), correlation)}"
        + f"<h2>Residuals</h2>{_html_table(_FIT_HEAD, fit_rows_of(found))}"
        + "".join(_figure(fit) for fit in found.fits)
        + "</html>\n"
    )


def _figure(fit: Fit) -> str:
    """Measured values as points, the model as a line; of long runs every so many samples."""
    width, height, left, bottom, most = 900, 220, 60, 24, 1500
    some = slice(None, None, max(1, fit.time.size // most))
    time, measured, simulated = fit.time[some], fit.measured[some], fit.simulated[some]
    low, high = float(min(measured.min(), simulated.min())), float(max(measured.max(), simulated.max()))
    span, duration = (high - low) or 1.0, (float(time[-1] - time[0])) or 1.0
    x = left + (time - time[0]) / duration * (width - left - 8)
    y1, y2 = ((high - one) / span * (height - bottom - 8) + 8 for one in (measured, simulated))
    points = "".join(f"M{a:.1f} {b:.1f}h0" for a, b in zip(x, y1))
    line = "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in zip(x, y2))
    marks = "".join(
        f'<text x="{left - 6}" y="{y}" text-anchor="end">{value:.4g}</text>' for y, value in ((16, high), (height - bottom, low))
    ) + "".join(
        f'<text x="{at}" y="{height - 6}" text-anchor="{anchor}">{value:.4g} s</text>'
        for at, anchor, value in ((left, "start", time[0]), (width - 8, "end", time[-1]))
    )
    label = f"{fit.channel} [{fit.unit}], {fit.run}"
    return (
        f'<figure><svg viewBox="0 0 {width} {height}" role="img" aria-label="{escape(label)}" font-size="12" fill="#555">'
        f'<path d="M{left} 8V{height - bottom}H{width - 8}" fill="none" stroke="#bbb"/>'
        f'<path d="{points}" fill="none" stroke="#8ab" stroke-width="3" stroke-linecap="round"/>'
        f'<path d="{line}" fill="none" stroke="#c40" stroke-width="1.5"/>{marks}</svg>'
        f"<figcaption>{escape(label)}: measured as points, the model as a line</figcaption></figure>"
    )
