"""The page around the panels: menus, layouts, theme, reconnection."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.studio import Server, Studio

_ALL = (
    "rqt_topic", "rqt_publisher", "rqt_ez_publisher", "rqt_msg", "rqt_service_caller", "rqt_srv",
    "action_caller", "rqt_action", "rqt_plot", "rqt_image_view", "rqt_tf_tree", "rqt_console",
    "rqt_logger_level", "rqt_bag", "rqt_graph", "rqt_top", "rqt_reconfigure", "rqt_param",
    "rqt_robot_steering", "joint_state_publisher_gui", "turtlesim",
)  # fmt: skip
_NAMELESS = """() => {
  const named = e => e.getAttribute('aria-label') || e.title || e.textContent.trim()
    || e.labels?.[0]?.textContent.trim();
  const controls = 'button, input, select, textarea, [role=tab], [tabindex="0"]';
  return [...document.querySelectorAll(controls)].filter(e => !named(e))
    .map(e => e.outerHTML.slice(0, 120));
}"""


def test_a_panel_opens_from_the_menu_by_keyboard_alone(bench: Any, look: Any) -> None:
    seen = look(bench.url, "rqt_graph")
    seen.page.keyboard.press("p")
    menu = seen.page.get_by_role("menu", name="Panels")
    menu.wait_for()
    seen.page.keyboard.press("T")
    for _ in range(20):
        if seen.page.evaluate("document.activeElement.textContent").startswith("Topic Monitor"):
            break
        seen.page.keyboard.press("ArrowDown")
    seen.shot("menu")
    seen.page.keyboard.press("Enter")
    seen.panel("rqt_topic").get_by_label("Filter topics").wait_for()
    assert not menu.is_visible()


def test_escape_closes_a_menu_and_gives_the_focus_back(bench: Any, look: Any) -> None:
    seen = look(bench.url, "rqt_graph")
    seen.page.get_by_role("button", name="Panels").click()
    seen.page.keyboard.press("Escape")
    assert seen.page.get_by_role("menu").count() == 0
    assert seen.page.evaluate("document.activeElement.textContent") == "Panels"


def test_a_named_layout_comes_back_with_the_state_of_its_panels(bench: Any, look: Any) -> None:
    seen = look(bench.url, "rqt_graph")
    seen.panel("rqt_graph").get_by_label("Nodes", exact=True).fill("robot")
    seen.page.get_by_role("button", name="Layout").click()
    seen.page.get_by_role("menuitem", name="Save layout as…").click()
    seen.page.get_by_label("Name").fill("mine")
    seen.page.keyboard.press("Enter")
    assert "Layout mine is saved" in seen.toast()
    seen.page.get_by_role("button", name="Layout").click()
    seen.page.get_by_role("menuitem", name="Graph and topics").click()
    seen.panel("rqt_topic").wait_for()
    seen.page.get_by_role("button", name="Layout").click()
    seen.page.get_by_role("menuitem", name="mine", exact=True).click()
    seen.panel("rqt_topic").wait_for(state="detached")
    assert seen.panel("rqt_graph").get_by_label("Nodes", exact=True).input_value() == "robot"


def test_a_reload_keeps_what_was_open(bench: Any, look: Any) -> None:
    seen = look(bench.url)
    seen.page.keyboard.press("p")
    seen.page.get_by_role("menuitem", name="Service Caller").click()
    seen.panel("rqt_service_caller").wait_for()
    bench.eventually(
        lambda: "rqt_service_caller" in (seen.page.evaluate("sessionStorage['gazelle.tab']") or "")
    )
    seen.page.reload()
    seen.panel("rqt_service_caller").wait_for()


def test_reset_brings_the_default_layout_back(bench: Any, look: Any) -> None:
    seen = look(bench.url, "rqt_graph")
    seen.page.keyboard.press("Alt+w")
    seen.panel("rqt_graph").wait_for(state="detached")
    seen.page.get_by_role("button", name="Layout").click()
    seen.page.get_by_role("menuitem", name="Reset layout").click()
    seen.panel("rqt_graph").wait_for()


def test_the_theme_is_switched_and_kept(bench: Any, look: Any) -> None:
    seen = look(bench.url, "rqt_graph")
    dark = seen.page.evaluate("getComputedStyle(document.body).backgroundColor")
    seen.page.get_by_role("button", name="Light or dark").click()
    light = seen.page.evaluate("getComputedStyle(document.body).backgroundColor")
    assert dark != light
    seen.page.reload()
    assert seen.page.evaluate("document.documentElement.dataset.theme") == "light"


def test_streams_go_on_after_the_server_came_back(bench: Any, look: Any, free_port: int) -> None:
    bench.keep_publishing("/chatter", "std_msgs/msg/String", lambda t: {"data": f"at {t:.0f}"})
    first = Server(Studio(bench.graph), port=free_port + 7)
    seen = look(first.url, "rqt_topic")
    seen.expect_problem("WebSocket connection to")
    seen.page.evaluate("window.same = true")
    seen.page.get_by_label("Subscribe /chatter", exact=True).check()
    seen.panel("rqt_topic").locator(".value", has_text="at ").wait_for()
    first.close()
    seen.page.get_by_text("The server does not answer").wait_for()
    with Server(Studio(bench.graph), port=free_port + 7):
        seen.page.locator(".light[data-state=open]").wait_for()
        value = seen.panel("rqt_topic").locator(".value", has_text="at ")
        said = value.inner_text()
        bench.eventually(lambda: value.inner_text() != said)
        assert seen.page.evaluate("window.same")
        seen.page.get_by_text("The server does not answer").wait_for(state="detached")


def test_an_error_names_what_there_is_instead(bench: Any, look: Any) -> None:
    bench.publish("/odom", "nav_msgs/msg/Odometry")
    seen = look(bench.url, "rqt_plot")
    seen.page.get_by_label("Topic field").fill("/odom/twist/twist/linear/xx")
    seen.page.keyboard.press("Enter")
    text = seen.toast()
    assert "has no field 'xx'" in text
    assert "There is: x" in text
    assert seen.panel("rqt_plot").get_by_text("no values yet").is_visible()


@pytest.mark.parametrize("theme", ["dark", "light"])
def test_every_control_of_every_panel_has_a_name(bench: Any, look: Any, theme: str) -> None:
    seen = look(bench.url, *_ALL, theme=theme)
    for kind in _ALL:
        seen.panel(kind).locator("> *").first.wait_for(state="attached")
    assert seen.page.evaluate(_NAMELESS) == []


def test_text_stands_out_from_what_is_behind_it(bench: Any, look: Any) -> None:
    """WCAG's contrast of 4.5 for text on panels, in both themes."""
    for theme in ("dark", "light"):
        seen = look(bench.url, "rqt_graph", theme=theme)
        for name in ("text", "dim", "accent", "ok", "warn", "error", "fatal"):
            assert _contrast(seen, name, "panel") >= 4.5, (theme, name)


def _contrast(seen: Any, one: str, other: str) -> float:
    def luminance(name: str) -> float:
        value = seen.page.evaluate(
            f"getComputedStyle(document.documentElement).getPropertyValue('--{name}').trim()"
        ).lstrip("#")
        parts = [int(value[at : at + 2], 16) / 255 for at in (0, 2, 4)]
        linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
        return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]

    high, low = sorted((luminance(one), luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)
