# Two springs in series: the rough interface and the flat punch behind it.


rule fit_interface:
    input:
        pools=expand("results/ensembles/{pool}.nc", pool=("discs", "lines", "size_discs", "size_lines")),
    output:
        csv="results/tables/interface.csv",
        nc="results/tables/interface.nc",
        curves_csv="results/tables/interface_curves.csv",
        curves_nc="results/tables/interface_curves.nc",
    log:
        "results/logs/fit_interface.log",
    benchmark:
        "results/benchmarks/fit_interface.tsv"
    localrule: True
    conda:
        "../envs/viscorough.yaml"
    resources:
        mem_mb=4000,
    params:
        fit=interface_limits(),
        rms_convention=config["figures"]["rms_convention"],
    message:
        "Interface and punch in series"
    script:
        "../scripts/fit_interface.py"
