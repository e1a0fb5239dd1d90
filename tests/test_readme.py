"""The example of the README runs as it stands."""

import re
from pathlib import Path

README = Path(__file__).parent.parent / "README.md"


def test_the_example_of_the_readme_runs(capsys):
    (code,) = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), flags=re.DOTALL)
    scope = {}
    exec(code, scope)  # what a reader would paste
    assert scope["result"].mesh.validate().n_nodes == len(scope["points"])
    assert re.fullmatch(r"\d+ swaps; the surface at \(0\.3, 0\.6\) is -0\.\d{3}\n", capsys.readouterr().out)


def test_pictures_of_the_readme_exist():
    for path in re.findall(r"!\[[^\]]+\]\(([^)]+)\)", README.read_text(encoding="utf-8")):
        assert (README.parent / path).is_file()
