"use strict";
/* The origin of a number, in one popover for all: by click, tap, Enter or space. Escape, or a click elsewhere, closes it.
   In a table or a paragraph one number takes part in the order of the tab key; arrows lead to the others. */

(function () {
  const popover = document.getElementById("origin");
  if (!("popover" in popover)) return; // an old browser; the tooltips remain
  const numbers = [...document.querySelectorAll("data[title]")].filter((number) => !number.closest("a, summary"));
  const groupOf = (number) => number.closest("table, p, dl") || document.body;
  const groups = new Map(); // {group: its numbers}
  let shown = null; // the number whose origin is shown

  for (const number of numbers) {
    const group = groupOf(number);
    if (!groups.has(group)) groups.set(group, []);
    number.tabIndex = groups.get(group).length ? -1 : 0;
    number.setAttribute("role", "button");
    number.setAttribute("aria-expanded", "false");
    groups.get(group).push(number);
  }

  /** Show where a number comes from, below it, or above it at the end of the window. */
  function show(number) {
    const parts = number.title.split("; ").map((text) => {
      const line = document.createElement("p");
      line.textContent = text;
      return line;
    });
    const exact = document.createElement("p");
    exact.textContent = `value ${number.value}`;
    popover.replaceChildren(exact, ...parts);
    popover.showPopover();
    const { left, top, bottom } = number.getBoundingClientRect();
    const below = bottom + popover.offsetHeight + 8 < innerHeight;
    popover.style.top = `${below ? bottom + 6 : Math.max(4, top - popover.offsetHeight - 6)}px`;
    popover.style.left = `${Math.max(4, Math.min(left, document.documentElement.clientWidth - popover.offsetWidth - 4))}px`;
    shown = number;
    shown.setAttribute("aria-expanded", "true");
  }

  /** Give the focus to a number, which then is the one of its group that the tab key reaches. */
  function focus(number, options) {
    if (popover.matches(":popover-open")) popover.hidePopover();
    for (const other of groups.get(groupOf(number))) other.tabIndex = -1;
    number.tabIndex = 0;
    number.focus(options);
  }

  popover.addEventListener("toggle", (event) => {
    if (event.newState === "closed" && shown && !popover.matches(":popover-open")) {
      shown.setAttribute("aria-expanded", "false");
      shown = null;
    }
  });
  addEventListener("scroll", () => popover.matches(":popover-open") && popover.hidePopover(), { passive: true });
  document.addEventListener("click", (event) => {
    const number = event.target.closest("data[role=button]");
    if (!number) return;
    focus(number, { preventScroll: true });
    show(number);
  });
  document.addEventListener("keydown", (event) => {
    const number = event.target.closest("data[role=button]");
    if (!number) return;
    if (event.key === "Enter" || event.key === " ") {
      event.preventDefault();
      focus(number);
      show(number);
    }
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step) {
      event.preventDefault();
      const group = groups.get(groupOf(number));
      const next = group[group.indexOf(number) + step];
      if (next) focus(next);
    }
  });
})();
