#!/usr/bin/env python3
"""Tries the examples of docs/ci.md: takes the files and the shell lines out of the page, renders, compares
with goldens that it accepts as the page says, and breaks a frame.

    ci_examples.py SKYLAPSE DOCS_CI_MD

Exit status 77: there is no PyYAML here (Debian package python3-yaml), or no OpenGL.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

try:
    import yaml
except ImportError:
    print("skipped: there is no PyYAML here (Debian package python3-yaml)")
    sys.exit(77)


def check(condition, text):
    if not condition:
        raise AssertionError(text)


def blocks(page, language):
    """Fenced blocks by the path in their first comment, else by their number."""
    found = {}
    for text in re.findall(rf"```{language}\n(.*?)```", page, re.DOTALL):
        named = re.match(r"# (\S+)\n", text)
        found[named.group(1) if named else str(len(found))] = text
    return found


class Scratch:
    """A repository in which the lines of the examples are run."""

    def __init__(self, folder, program):
        self.folder = pathlib.Path(folder)
        self.environment = {**os.environ, "LIBGL_ALWAYS_SOFTWARE": "1",
                            "PATH": str(pathlib.Path(program).resolve().parent) + os.pathsep + os.environ["PATH"]}

    def write(self, path, text):
        target = self.folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)

    def run(self, lines, expected=0):
        """As runners do: bash that stops at the first failure."""
        done = subprocess.run(["bash", "-eo", "pipefail", "-c", lines], cwd=self.folder, env=self.environment,
                              capture_output=True, text=True)
        check(done.returncode == expected, f"exit status {done.returncode}, not {expected}, of:\n{lines}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr


def check_syntax(name, lines):
    done = subprocess.run(["bash", "-n"], input=lines, capture_output=True, text=True)
    check(done.returncode == 0, f"{name}: {done.stderr}")


def github_steps(text):
    """The lines of the steps by their names. YAML 1.1 reads the key "on" as true."""
    workflow = yaml.safe_load(text)
    check(set(workflow) == {"name", True, "jobs"}, f"keys of the workflow: {list(workflow)}")
    steps = {}
    for job in workflow["jobs"].values():
        check("runs-on" in job and job["steps"], "a job runs nowhere, or does nothing")
        for step in job["steps"]:
            check(("uses" in step) != ("run" in step), f"a step uses and runs, or neither: {step}")
            check("uses" not in step or re.search(r"@v\d+$", step["uses"]), f"no version: {step}")
            if "run" in step:
                check_syntax(step["name"], step["run"])
                steps[step["name"]] = step["run"]
    return steps


def gitlab_jobs(text):
    pipeline = yaml.safe_load(text)
    jobs = {name: job for name, job in pipeline.items() if isinstance(job, dict)}
    for name, job in jobs.items():
        check(job["stage"] in pipeline["stages"], f"{name} is in no stage")
        check_syntax(name, "\n".join(job.get("before_script", []) + job["script"]))
    return jobs


def try_examples(page, scratch, yaml_blocks, accept):
    steps, jobs = github_steps(yaml_blocks[".github/workflows/skies.yml"]), gitlab_jobs(yaml_blocks[".gitlab-ci.yml"])
    compare_on_gitlab = "\n".join(line for line in jobs["skies"]["script"] if "render" not in line)
    check("report/junit.xml" == jobs["skies"]["artifacts"]["reports"]["junit"], "GitLab does not see the JUnit report")
    check(jobs["skies"]["allow_failure"]["exit_codes"] == [1], "warnings fail on GitLab")

    scratch.write("ci/skies.yaml", yaml_blocks["ci/skies.yaml"])
    scratch.run(accept)
    frames = sorted((scratch.folder / "out").glob("*.exr"))
    check(len(frames) == 3 and (scratch.folder / "ci/golden/golden.json").exists(), f"frames: {frames}")
    shutil.rmtree(scratch.folder / "out")

    # The same again: rendered by the workflow's step, equal on both systems.
    scratch.run(steps["Render"])
    scratch.run(steps["Compare"])
    for name in ("report/junit.xml", "report/diff.json", "report/index.html"):
        check((scratch.folder / name).stat().st_size > 100, f"{name} is empty")
    scratch.run(compare_on_gitlab)
    self_check = re.search(r"`(skylapse diff [^`]*--self-check[^`]*)`", page).group(1)
    scratch.run(self_check)

    # 0.1 % brighter: a warning, which the workflow turns into success and GitLab lets pass.
    kept = frames[0].read_bytes()
    scratch.run(f"oiiotool {frames[0]} --mulc 1.001 -o {frames[0]}")
    check("::warning::" in scratch.run(steps["Compare"]), "a warning goes unseen")
    scratch.run(compare_on_gitlab, expected=1)
    frames[0].write_bytes(kept)

    # A frame of another time in the place of one fails on both, and so does a file that is cut short.
    shutil.copy(frames[2], frames[1])
    told = scratch.run(steps["Compare"], expected=2)
    check(frames[1].name in told, f"the frame is not named: {told}")
    scratch.run(compare_on_gitlab, expected=2)
    frames[1].write_bytes(frames[0].read_bytes()[:5000])
    scratch.run(steps["Compare"], expected=4)


def main():
    program, document = sys.argv[1:3]
    page = pathlib.Path(document).read_text()
    doctor = subprocess.run([program, "doctor"], capture_output=True, text=True)
    with tempfile.TemporaryDirectory() as folder:
        scratch = Scratch(folder, program)
        try:
            try_examples(page, scratch, blocks(page, "yaml"), next(iter(blocks(page, "sh").values())))
        except AssertionError as problem:
            if "exit status 5" in str(problem):
                print(f"skipped: there is no OpenGL here\n{doctor.stdout}")
                return 77
            raise
    print("the examples of docs/ci.md work")
    return 0


if __name__ == "__main__":
    sys.exit(main())
