"""The schema of the settings and the tables of config/README.md, from viscorough_study/run/settings_model.py."""

import write_settings


def test_schema_is_that_of_the_model():
    assert write_settings.SCHEMA.read_text(encoding="utf-8") == write_settings.schema_text(), (
        "run docs/write_settings.py"
    )


def test_tables_are_those_of_the_model():
    page = write_settings.PAGE.read_text(encoding="utf-8")
    assert write_settings.page_text(page) == page, "run python docs/write_settings.py"


def test_page_explains_every_setting_once():
    page = write_settings.PAGE.read_text(encoding="utf-8").split("## Keys")[1]
    explained = [line.split("`")[1] for line in page.splitlines() if line.startswith("| `")]
    properties = write_settings.schema()["properties"]
    assert sorted(explained) == sorted(
        key for name, rule in properties.items() for key, _ in write_settings.keys(rule, name)
    )
    assert len(explained) > 100


def test_outdated_table_is_written_again():
    page = "# Settings\n\n<!-- settings: seed interface -->\n\n| key |\n|---|\n| `sead` |\n\nText.\n"
    written = write_settings.page_text(page)
    rows = [line for line in written.splitlines() if line.startswith("| `")]
    assert [row.split(" | ")[0] for row in rows] == ["| `seed`", "| `interface.plateau`"]
    assert rows[1].split(" | ")[2] == "> 0 to 0.5"
    assert written.endswith("\n\nText.\n")
