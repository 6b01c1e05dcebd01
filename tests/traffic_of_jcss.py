"""Traffic with the laws of JCSS."""

from pierimpact.risk.traffic import Traffic, jcss_angle, jcss_deceleration, jcss_mass, jcss_speed


def jcss_traffic(trucks, distance, **others):
    """Return traffic with the laws of JCSS for what is not given; arguments as of `Traffic`."""
    laws = {
        "mass": jcss_mass(),
        "speed": jcss_speed(),
        "deceleration": jcss_deceleration(),
        "angle": jcss_angle(),
    }
    return Traffic(trucks=trucks, distance=distance, **(laws | others))
