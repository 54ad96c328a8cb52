MathJax.Hub.Config({ messageStyle: "none", showMathMenu: false, menuSettings: { zoom: "None" }, SVG: { font: "TeX", scale: 90 } });
