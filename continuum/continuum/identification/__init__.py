"""The thesis's identification: its particle swarm (Table 2) and its objective (Eq. 19), on named free parameters.

`continuum.discovery` estimates the same parameters by the grey-box model of `continuum.estimation`.
"""
