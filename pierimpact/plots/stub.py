"""stub"""


def _svg(w, h, name):
    return f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}mm" height="{h}mm" viewBox="0 0 {w} {h}"><rect width="{w}" height="{h}" fill="#eee" stroke="#999"/></svg>'


def draw_situation(*a):
    return _svg(92, 88, "")


def draw_crush_curves(*a):
    return _svg(168, 48, "")


def draw_shape(*a):
    return _svg(60, 60, "")


def draw_history(*a):
    return _svg(168, 70, "")


def draw_spectrum(*a):
    return _svg(168, 65, "")


def draw_envelopes(*a):
    return _svg(168, 80, "")


def draw_code_bars(*a):
    return _svg(168, 55, "")


def draw_tornado(*a):
    return _svg(168, 60, "")
