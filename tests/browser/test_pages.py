"""Every page of the built book in a real browser, from a server and from the disk."""

import pytest
from conftest import SITE
from visiting import explorers_of, pages_of, watched

PAGES = pages_of(SITE)
EXPLORERS = {
    "notebooks/03-methods.html": 1,
    "notebooks/05-results.html": 2,
    "notebooks/06-modifications.html": 2,
    "notebooks/07-further-work.html": 1,
}


@pytest.mark.parametrize("name", PAGES)
def test_loads_with_no_error_and_asks_no_other_host(chromium, address, name):
    with chromium.new_page() as page:
        wrong = watched(page, address)
        page.goto(f"{address}/{name}", wait_until="load")
        assert len(explorers_of(page)) == EXPLORERS.get(name, 0)
        page.wait_for_load_state("networkidle")
        assert wrong == []


def test_every_page_of_the_contents_is_built(site):
    assert set(EXPLORERS) < set(PAGES)


@pytest.mark.parametrize("name", EXPLORERS)
def test_explorers_fit_a_phone(chromium, site, name):
    with chromium.new_page(viewport={"width": 375, "height": 700}) as page:
        page.goto(f"{site.as_uri()}/{name}")
        for explorer in explorers_of(page):
            # the page scrolls down, not sideways, and nothing of an explorer sticks out
            right = explorer.evaluate(
                "e => Math.max(...Array.from(e.querySelectorAll('.mesh-page *'),"
                " part => part.getBoundingClientRect().right))"
            )
            assert right <= 375
        assert page.evaluate("document.documentElement.scrollWidth") <= 375
