"""Keys and screen readers: no violation of WCAG 2.1, levels A and AA, anywhere on the page."""

from __future__ import annotations

import re
from typing import Any

import pytest
from tests.browser.axe import check_page, violations

# Dialogs and menus that a panel opens by a button: kind of panel → names of buttons.
OPENED = {
    "displays": ("Add", "More"),
    "rviz": ("View",),
    "gazebo": ("View",),
}


@pytest.fixture
def robot(bench: Any) -> Any:
    """A graph with something for panels to show."""
    bench.publish("/scan", "sensor_msgs/msg/LaserScan")
    bench.publish("/odom", "nav_msgs/msg/Odometry")
    bench.graph.parameters.set("/robot_name", "bot")
    bench.node.log("error", "the battery is low")
    bench.node.log("warn", "it is dark")
    return bench


def test_keys_reach_everything_around_the_panels(robot: Any, look: Any) -> None:
    seen = look(robot.url, "rqt_topic", "rqt_console")
    keys, page = seen.page.keyboard, seen.page
    seen.panel("rqt_topic").wait_for()
    # The menu of panels: letters and arrows choose, Escape gives the focus back.
    keys.press("p")
    page.get_by_role("menu").wait_for()
    check_page(page, "the menu Panels")
    keys.press("ArrowDown")
    assert page.evaluate("document.activeElement.getAttribute('role')") == "menuitem"
    keys.press("Escape")
    assert page.evaluate("document.activeElement.textContent") == "Panels"
    # Help on the panel that is in front, by key and by its button.
    keys.press("F1")
    page.get_by_role("dialog", name=re.compile("Topic Monitor|Console")).wait_for()
    check_page(page, "the help of a panel")
    keys.press("Escape")
    page.get_by_role("dialog").wait_for(state="detached")
    helps = page.get_by_role("button", name="Help on Topic Monitor")
    helps.focus()
    keys.press("Enter")
    dialog = page.get_by_role("dialog", name="Topic Monitor")
    assert "rqt_topic" in dialog.inner_text()
    keys.press("Enter")
    dialog.wait_for(state="detached")
    assert helps.evaluate("(element) => element === document.activeElement")
    # From one group of panels to the next.
    keys.press("F6")
    first = page.evaluate("document.activeElement.textContent")
    keys.press("F6")
    assert {first, page.evaluate("document.activeElement.textContent")} == {
        "Topic Monitor",
        "Console",
    }
    # The list of shortcuts, and a tab that is closed by a key.
    keys.press("?")
    page.get_by_role("dialog", name="Keyboard shortcuts").wait_for()
    check_page(page, "the shortcuts")
    keys.press("Escape")
    page.get_by_role("tab", name="Console").focus()
    keys.press("Delete")
    seen.panel("rqt_console").wait_for(state="detached")


def test_the_focus_is_seen_wherever_tab_leads(robot: Any, look: Any) -> None:
    seen = look(robot.url, "rqt_console")
    seen.panel("rqt_console").wait_for()
    names: list[str] = []
    for _ in range(30):
        seen.page.keyboard.press("Tab")
        at = seen.page.evaluate(
            "(() => { const at = document.activeElement, style = getComputedStyle(at);"
            "return [at.getAttribute('aria-label') || at.textContent.trim() || at.tagName,"
            "style.outlineStyle !== 'none' || at.matches('[role=tab], .virtual')"
            "|| at === document.body]; })()"
        )
        names.append(at[0])
        assert at[1], f"the focus is not seen on {at[0]}"
    assert "Panels" in names
    assert "Help on Console" in names
    assert any("Messages" in name for name in names)


@pytest.mark.slow(90)
@pytest.mark.parametrize("theme", ["dark", "light"])
def test_no_panel_violates_the_rules(robot: Any, look: Any, theme: str) -> None:
    seen = look(robot.url, "rqt_console", theme=theme)
    page = seen.page
    seen.panel("rqt_console").wait_for()
    seen.expect_problem("GL Driver Message")
    page.keyboard.press("p")
    items = page.get_by_role("menuitem")
    kinds = items.locator(".menu-note").all_inner_texts()
    page.keyboard.press("Escape")
    assert len(kinds) > 30
    wrong: list[str] = []
    for kind in kinds:
        page.keyboard.press("p")
        items.filter(has=page.locator(f".menu-note:text-is('{kind}')")).click()
        panel = seen.panel(kind).last
        panel.locator("> *").first.wait_for()
        wrong += [f"{kind}: {one}" for one in violations(page)]
        for name in OPENED.get(kind, ()):
            panel.get_by_role("button", name=name, exact=True).click()
            wrong += [f"{kind}, {name}: {one}" for one in violations(page)]
            page.keyboard.press("Escape")
        page.keyboard.press("Alt+w")
    assert not wrong, "\n".join(dict.fromkeys(wrong))
