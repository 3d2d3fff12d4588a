# Tables as HTML pages for the report, in one job per target.

for target in dict.fromkeys(table["target"] for table in TABLES.values()):

    rule:
        name:
            f"show_tables_of_{target}"
        input:
            csv=expand("results/tables/{table}.csv", table=shown_tables_of(target)),
            nc=expand("results/tables/{table}.nc", table=shown_tables_of(target)),
        output:
            html=[
                report(
                    f"results/tables/{name}.html",
                    caption=f"../report/tables/{name}.rst",
                    category=chapter(table["chapter"]),
                    labels={"result": table["label"], "kind": "table"},
                )
                for name, table in shown_tables_of(target).items()
            ],
        localrule: True
        resources:
            mem_mb=1000,
        params:
            page_digests(),
        message:
            f"Pages of the tables of {target}"
        script:
            "../scripts/show_tables.py"
