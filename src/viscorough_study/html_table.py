"""Tables as pages of HTML, which open in a browser and in Snakemake's report."""

import html

_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
body {{ font: 14px/1.4 system-ui, sans-serif; margin: 1.5em; color: #222; background: #fff; }}
h1 {{ font-size: 1.3em; }}
.wide {{ overflow-x: auto; }}
table {{ border-collapse: collapse; }}
th, td {{ padding: .2em .7em; text-align: left; vertical-align: top; border-bottom: 1px solid #ddd; }}
th {{ position: sticky; top: 0; background: #f4f4f4; }}
{numbers} {{ text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }}
dt {{ font-weight: 600; }}
dd {{ margin: 0 0 .3em 1.5em; }}
</style>
</head>
<body>
<h1>{title}</h1>
<p>{rows} rows. Numbers have four digits here, and all of their digits in <code>{csv}</code> beside this file.</p>
<div class="wide" tabindex="0">
{table}
</div>
<h2>Columns</h2>
<dl>
{columns}
</dl>
</body>
</html>
"""


def html_table(table, columns, title, csv_name):
    """A page with all rows of a tidy table (pandas.DataFrame) and the meaning of its columns.

    columns : {column: (long_name, units)}; csv_name : of the file with all digits, which the page names
    """
    shown = table[list(columns)].rename_axis(columns=None)
    for name in shown.select_dtypes(bool):
        shown[name] = shown[name].map({True: "yes", False: "no"})
    numbers = [f"td:nth-child({place})" for place, kind in enumerate(shown.dtypes, 1) if kind.kind in "iuf"]
    meanings = (
        f"<dt>{html.escape(name)}</dt><dd>{html.escape(long_name)}{_unit(units)}</dd>"
        for name, (long_name, units) in columns.items()
    )
    return _PAGE.format(
        title=html.escape(title),
        csv=html.escape(csv_name),
        rows=len(table),
        numbers=", ".join(numbers) or "td.number",
        table=shown.to_html(index=False, border=0, na_rep="", float_format="{:.4g}".format),
        columns="\n".join(meanings),
    )


def _unit(units):
    return f" [{html.escape(units)}]" if units not in (None, "", "1") else ""
