using System.Collections.Generic;
using UnityEngine.SceneManagement;

namespace UnityEngine
{
    /// The objects that await destruction. Each is destroyed at the end of the frame in which its delay has passed.
    static class Destruction
    {
        readonly struct Request
        {
            public readonly Object Target;
            public readonly double Due;

            public Request(Object target, double due)
            {
                Target = target;
                Due = due;
            }
        }

        static readonly List<Request> Requests = new List<Request>();

        public static void Schedule(Object target, float delay) => Requests.Add(new Request(target, Time.EndOf(delay)));

        /// Destroys all objects that are due, including objects whose destruction is requested meanwhile.
        public static void RunDue()
        {
            if (Requests.Count == 0) return;
            var remaining = 0;
            for (var index = 0; index < Requests.Count; index++)
            {
                var request = Requests[index];
                if (request.Target.destroyed) continue;
                if (request.Due <= Time.timeAsDouble) Destroy(request.Target);
                else Requests[remaining++] = request;
            }
            Requests.RemoveRange(remaining, Requests.Count - remaining);
        }

        public static void Destroy(Object target)
        {
            // A script can destroy its object again in OnDestroy.
            if (target.isBeingDestroyed || target is Component part && part.owner.isBeingDestroyed) return;
            switch (target)
            {
                case Transform _:
                    Debug.LogError("A Transform cannot be destroyed; destroy its GameObject.", target);
                    break;
                case GameObject gameObject:
                    Destroy(gameObject);
                    break;
                case Component component:
                    Destroy(component);
                    break;
                case ScriptableObject script:
                    script.isBeingDestroyed = true;
                    var messages = Messages.Of(script.GetType());
                    Messages.Send(messages.OnDisable, script);
                    Messages.Send(messages.OnDestroy, script);
                    script.destroyed = true;
                    break;
                default:
                    target.destroyed = true;
                    break;
            }
        }

        static void Destroy(Component component)
        {
            if (component.owner.FindDependent(component) is Component dependent)
            {
                Debug.LogError($"Can't remove {component.GetType().Name} because {dependent.GetType().Name} depends on it.", component);
                return;
            }
            component.isBeingDestroyed = true;
            if (component.owner.activeInHierarchy) component.Deactivate();
            SendOnDestroy(component);
            component.owner.components.Remove(component);
            component.destroyed = true;
        }

        static void Destroy(GameObject gameObject)
        {
            gameObject.isBeingDestroyed = true;
            gameObject.SetActive(false); // OnDisable of all, before any OnDestroy
            var toDestroy = new List<GameObject>();
            Collect(gameObject, toDestroy);
            foreach (var one in toDestroy) one.isBeingDestroyed = true;
            foreach (var one in toDestroy)
                for (var index = 0; index < one.components.Count; index++) SendOnDestroy(one.components[index]);
            gameObject.TransformUnchecked.Detach();
            foreach (var one in toDestroy)
            {
                foreach (var component in one.components) component.destroyed = true;
                one.destroyed = true;
            }
            gameObject.TransformUnchecked.parentOrNull?.ChildrenChanged();
        }

        static void SendOnDestroy(Component component)
        {
            if (component is MonoBehaviour script && script.HasAwoken && !script.destroyed) Messages.Send(script.messages.OnDestroy, script);
        }

        static void Collect(GameObject gameObject, List<GameObject> into)
        {
            into.Add(gameObject);
            foreach (var child in gameObject.TransformUnchecked.children) Collect(child.owner, into);
        }

        /// Destroys all objects of all scenes, in the order of their roots. As in Unity, objects that scripts create meanwhile are an error.
        public static void DestroyScene()
        {
            foreach (var root in new List<GameObject>(Scene.AllRoots())) Destroy(root);
            foreach (var root in new List<GameObject>(Scene.AllRoots()))
            {
                Debug.LogError($"'{root.NameImpl}' was created while its scene was closed, for example in OnDestroy. It is destroyed without messages.", root);
                foreach (var script in root.GetComponentsInChildren<MonoBehaviour>(true)) script.Silence();
                Destroy(root);
            }
            Requests.Clear();
        }
    }
}
