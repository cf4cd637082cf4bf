"""Sets that are joined: which of some things are connected."""


class UnionFind:
    def __init__(self, things):
        self.parent = {thing: thing for thing in things}

    def root(self, thing):
        """The one of its set that stands for all."""
        while self.parent[thing] != thing:
            self.parent[thing] = self.parent[self.parent[thing]]
            thing = self.parent[thing]
        return thing

    def join(self, a, b):
        self.parent[self.root(a)] = self.root(b)

    def sets(self):
        """Lists of things; sets and things in the order in which they were given."""
        sets = {}
        for thing in self.parent:
            sets.setdefault(self.root(thing), []).append(thing)
        return list(sets.values())
