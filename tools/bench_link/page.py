def page(results): return "x\n"
