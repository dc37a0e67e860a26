"use strict";
// What the pages share: elements by id, new elements, numbers with a few digits.
const byId = id => document.getElementById(id);
const make = (tag, attributes = {}, ...children) => {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "on") for (const [name, f] of Object.entries(value)) node.addEventListener(name, f);
    else if (value !== null && value !== undefined) node.setAttribute(key, value);
  }
  node.append(...children);
  return node;
};
const digits = (x, n = 2) => x >= 100 ? Math.round(x).toString() : Number(x.toPrecision(n)).toString();
