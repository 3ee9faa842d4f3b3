# diptych: order and labels of the parameters of a sensitivity study
# SPDX-License-Identifier: LGPL-2.1-or-later


def short(key):
    """"friction angle peak" of the key continuum/friction_angle_peak."""
    return key.partition("/")[2].replace("_", " ")


def labels(record):
    """{key: label}; the index of a share or drop is that of the ratio, not of the key."""
    return {p["key"]: short(p["key"]) + (" (share)" if p["of"] else "") for p in record["parameters"]}


def by_total(one):
    """The parameters of a quantity, the largest total index first."""
    return sorted(one["parameters"], key=lambda p: -p["total"]["value"])
