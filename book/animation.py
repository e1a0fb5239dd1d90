"""Film the explorer for the README in the built book, as an animated WebP: ``python book/animation.py``.

SR2 on the 81 nodes, swap by swap: frames at equal steps through the accepted swaps.
"""

import shutil
from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import sync_playwright

from meshlib.thesis import explorers

HERE = Path(__file__).parent
PAGE = HERE.parent / "_build" / "html" / "notebooks" / "03-methods.html"
TARGET = HERE / "_static" / "explorer.webp"
SETTINGS = {"function": "SR2", "nodes": "81", "criterion": "jnd", "norm": 2}
FRAMES = 15
TICK, REST = 400, 2500  # milliseconds that a frame is shown; the first and the last


def addresses():
    """The links to the frames of the film."""
    accepted = explorers.SWAPS.computed(SETTINGS).trace["accepted"]
    made = np.append(0, np.flatnonzero(accepted) + 1)
    settings = "&".join(f"{name}={value}" for name, value in SETTINGS.items())
    for frame in made[np.linspace(0, len(made) - 1, FRAMES).round().astype(int)]:
        yield f"#explorer-swaps?{settings}&frame={frame}"


def film():
    """A picture of the explorer for each link."""
    with sync_playwright() as running:
        browser = running.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
        page = browser.new_page(viewport={"width": 1300, "height": 1800}, color_scheme="light")
        page.goto(PAGE.as_uri())
        explorer = page.locator(".tag_explorer-swaps .mesh-page")
        explorer.wait_for()
        page.add_style_tag(
            content=".bd-header, .readout, .tools { display: none !important; }.mesh-page { padding: 12px; }"
        )
        for address in addresses():
            page.evaluate("address => { location.hash = address; }", address)
            page.wait_for_timeout(TICK)
            yield Image.open(BytesIO(explorer.screenshot())).convert("RGB")
        browser.close()


if __name__ == "__main__":
    first, *others = film()
    first.save(
        TARGET,
        save_all=True,
        append_images=others,
        loop=0,
        lossless=True,
        method=4,
        duration=[REST] + [TICK] * (FRAMES - 2) + [REST],
    )
