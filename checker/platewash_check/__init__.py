"""A second, independent prover of platewash's plans: it confirms each requirement, or says where it cannot."""
