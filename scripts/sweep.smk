# A planned sweep with Snakemake, which scripts/setup sweeps installs. Times are measured one shard after the other, since
# jobs side by side disturb each other; a sweep planned with --effort accuracy uses as many cores as Snakemake is given.
#
# example: build/release/bin/touchmark plan --mesh bunny --query all --out sweep.json
#          snakemake -s scripts/sweep.smk --cores all --config manifest=sweep.json out=sweep shards=8
#
# leaves out/results.csv. Stopped and started again, it goes on where it was; finished jobs are in out/jobs.
import json
import pathlib

MANIFEST = config.get("manifest", "sweep.json")
OUT = config.get("out", "sweep")
SHARDS = int(config.get("shards", 4))
PROGRAM = config.get("program", str(pathlib.Path(workflow.basedir).parent / "build/release/bin/touchmark"))
TIMED = json.loads(pathlib.Path(MANIFEST).read_text(encoding="utf-8"))["effort"] != "accuracy"


rule results:
    input: expand("{out}/shard-{i}", out=OUT, i=range(1, SHARDS + 1))
    output: f"{OUT}/results.csv"
    shell: "{PROGRAM:q} merge {OUT:q}/jobs --manifest {MANIFEST:q} --out {output:q}"


rule shard:
    input: MANIFEST
    output: touch(OUT + "/shard-{i}")
    threads: workflow.cores if TIMED else 1
    shell: "{PROGRAM:q} run --manifest {input:q} --shard {wildcards.i}/{SHARDS} --out {OUT:q}/jobs"
